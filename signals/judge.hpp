// Evaluates the properties of a run, and describes the verdicts in words.  Pure, except for reading the run's folder.
#pragma once

#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "signals/properties/evaluation.hpp"
#include "signals/properties/property_file.hpp"

namespace skein::signals {

struct PropertyFinding {
  std::string name;
  properties::Verdict verdict;  ///< the worst verdict of the property's cases

  /// "margin 0.42 m (u = changi), decided at 31.25 s", "vacuous: ...", "it did not hold at 3 s, margin -0.1 m".
  std::string text() const;
};

/// @returns one finding per property, in the set's order. @throws InputError when the run lacks one of their signals.
std::vector<PropertyFinding> judge_properties(const properties::PropertySet& set, properties::RunSignals& run);

/// Whether any property compares the run with the same run without faults.
bool needs_undisturbed(const properties::PropertySet& set);

/// Adds an error for each property whose deadline after the end of the plan's last fault is beyond the mission's end.
/// @param key  key of the properties in the file: "properties"
void check_against_plan(const properties::PropertySet& set, const FaultPlan& plan, const Scenario& scenario,
                        const std::string& key, ConfigErrors& errors);

}  // namespace skein::signals
