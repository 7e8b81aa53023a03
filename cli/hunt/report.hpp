// What is said of a hunt when it is over: JUnit XML for CI servers.  Writes files.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/hunt/finds.hpp"
#include "cli/hunt/plan.hpp"

namespace skein::cli {

struct HuntSummary {
  const HuntPlan& plan;
  const std::vector<std::optional<TrialOutcome>>& outcomes;  ///< by case
  std::size_t count = 0;                                     ///< of cases that count
  std::size_t states = 0;
  const std::vector<Find>& finds;
  const std::map<std::string, std::size_t>& failures;  ///< by property
};

/// What became of a property in all cases of a hunt.
struct PropertyRecord {
  std::string name;
  std::size_t held = 0, failed = 0, vacuous = 0;
  std::optional<double> least = {};  ///< margin
  std::size_t least_in = 0;          ///< case
};

/// In the order of the plan, kCompletes first.
std::vector<PropertyRecord> property_records(const HuntSummary& summary);

/// The page, in the style of a run's: properties and their margins, finds with their faults on the axis of their
/// margin's time, and how much of the fleet's states was met.
std::string hunt_page(const HuntSummary& summary);

/// report.html; --junit: a case for each property. @throws InputError when that cannot be written.
void write_hunt_report(const HuntSummary& summary);

}  // namespace skein::cli
