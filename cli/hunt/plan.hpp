// What a hunt flies and asks, decided before anything flies; and the capsules that come of it, which are fault tests
// with the mark of what failed. Reads and writes files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/fault_tests/fault_test.hpp"
#include "cli/hunt/fault_maker.hpp"
#include "cli/hunt/trial.hpp"
#include "cli/run/fleet_plan.hpp"
#include "properties/property_file.hpp"

namespace skein::cli {

struct HuntPlan {
  HuntOptions options;
  FleetPlan fleet;
  properties::PropertyEntries entries;  ///< what is asked, as files spell it
  FaultSpace space;
  bool one_process = false;  ///< else over DDS
  std::filesystem::path out = {};
  Json settings = {};  ///< what the search depends on
};

/// @throws InputError for whatever is wrong in what the user gave.
HuntPlan plan_hunt(const HuntOptions& options);

/// Digest of all programs that fly: other programs are another search.
std::string programs_digest(const FleetPlan& fleet);

/// Its first letters, as capsules name the build that they were found with.
std::string build_of(const HuntPlan& plan);

/// What is asked of a fleet.
properties::PropertySet properties_of(const properties::PropertyEntries& entries, const Scenario& scenario);

/// So much of a mission stays for what must hold after the last fault.
double longest_deadline_s(const properties::PropertySet& set);

/// A fault test (docs/how-to-test-faults.md) that fails as the find did.
/// @param told  what was seen, in a line
std::string capsule_text(const std::string& name, const Trial& trial, const CapsuleMark& mark, const std::string& told,
                         const properties::PropertyEntries& entries);

}  // namespace skein::cli
