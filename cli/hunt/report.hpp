// The report of a finished hunt: report.html, and JUnit XML for CI servers.  Writes files.
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
  const std::vector<std::optional<TrialOutcome>>& outcomes;  ///< by number of the case; nullopt: not flown
  std::size_t count = 0;                                     ///< number of cases that count, from case 0 on
  std::size_t states = 0;  ///< distinct states of the fleet that the hunt met (trial.hpp)
  const std::vector<Find>& finds;
  const std::map<std::string, std::size_t>& failures;  ///< number of failed cases, by property
};

/// The outcomes of one property over all cases of a hunt, and its least margin.
struct PropertyRecord {
  std::string name;
  std::size_t held = 0, failed = 0, vacuous = 0;
  std::optional<double> least = {};  ///< least margin, in SI units; nullopt: no case has a margin
  std::size_t least_in = 0;          ///< number of the case with the least margin
};

/// One record per property: kCompletes first, then in the order of the plan.
std::vector<PropertyRecord> property_records(const HuntSummary& summary);

/// The page as HTML, in the style of a run's report: properties with their least margins, finds with a chart of the
/// margin and the faults over time, and the number of states of the fleet that the hunt met.
std::string hunt_page(const HuntSummary& summary);

/// Writes report.html, and with --junit a test case per property. @throws std::runtime_error when the page cannot be
/// written, InputError when the JUnit file cannot.
void write_hunt_report(const HuntSummary& summary);

}  // namespace skein::cli
