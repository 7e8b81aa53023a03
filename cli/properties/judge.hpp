// What became of the properties of a run, and how it is told.  Pure, but for the run's folder.
#pragma once

#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "properties/evaluation.hpp"
#include "properties/property_file.hpp"

namespace skein::cli {

struct PropertyFinding {
  std::string name;
  properties::Verdict verdict;  ///< the worst of its cases

  /// "margin 0.42 m (u = changi) at 31.25 s", "vacuous: ...", "it did not hold at ...".
  std::string text() const;
};

/// @throws InputError when a signal is not known of this run.
std::vector<PropertyFinding> judge_properties(const properties::PropertySet& set, properties::RunSignals& run);

/// Whether a property is about a comparison with the run without faults.
bool needs_undisturbed(const properties::PropertySet& set);

/// Adds an error for what a run of this length cannot decide: so long after the end of the last fault of the plan.
/// @param key  under which the properties stand: "properties"
void check_against_plan(const properties::PropertySet& set, const FaultPlan& plan, const Scenario& scenario,
                        const std::string& key, ConfigErrors& errors);

}  // namespace skein::cli
