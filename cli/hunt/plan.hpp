// The plan of a hunt, made before the first flight: what it flies and which properties it evaluates. Also the text of a
// capsule, a fault test that names the property that failed. Reads files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/fault_tests/fault_test.hpp"
#include "cli/hunt/fault_maker.hpp"
#include "cli/hunt/trial.hpp"
#include "cli/hunt_options.hpp"
#include "run/fleet_plan.hpp"
#include "signals/properties/property_file.hpp"

namespace skein::cli {

struct HuntPlan {
  HuntOptions options;
  FleetPlan fleet;
  properties::PropertyEntries entries;  ///< properties to evaluate, as files spell them
  FaultSpace space;
  bool one_process = false;  ///< false: over DDS
  std::filesystem::path out = {};
  Json settings = {};  ///< everything on which the search depends
};

/// @throws InputError for any invalid option or file.
HuntPlan plan_hunt(const HuntOptions& options);

/// Digest of all programs that fly. A hunt cannot be continued with other programs.
std::string programs_digest(const FleetPlan& fleet);

/// The first letters of that digest, by which capsules name the build that flew them.
std::string build_of(const HuntPlan& plan);

/// The longest deadline of a property that must hold after the last fault [simulated s]; 0: none has one. A mission
/// must go on for at least that long after its last fault.
double longest_deadline_s(const properties::PropertySet& set);

/// The text of a capsule: a fault test (docs/how-to-test-faults.md) that repeats a find.
/// @param told  what failed, in a line
std::string capsule_text(const std::string& name, const Trial& trial, const CapsuleMark& mark, const std::string& told,
                         const properties::PropertyEntries& entries);

}  // namespace skein::cli
