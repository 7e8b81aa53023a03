// Faults that change the scenario's conditions for some time: more wind, rain or less light, for example.  Pure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario/conditions.hpp"

namespace skein {

/// Indices of the faults that change conditions in the exchange at a tick, in the file's order.
std::vector<std::size_t> active_changes(const FaultPlan& plan, Tick tick);

/// The scenario's conditions with the changes of these faults, in their order. The function parses the values of the
/// faults, so call it only when the set of active faults has changed.
/// @param plan  its faults are from load_fault_plan() and read_faults_by_hand(), which have checked their values.
/// @param faults  as active_changes() returns them.
ConditionsConfig changed_conditions(const FaultPlan& plan, const Scenario& scenario,
                                    const std::vector<std::size_t>& faults);

/// Adds an error if the values of a ConditionsChange, or one of their sections, are empty; for each key that cannot
/// change during a run; and for each section that the change would switch on (wind, odometry, battery, radio) or off
/// (radio), which is impossible during a run. The reader of fault files checks the names and ranges of the keys.
/// @param path  key path of the change in its file: "faults[2].conditions".
void check_conditions_change(const ConfigNode& values, const Scenario& scenario, const std::string& path,
                             ConfigErrors& errors);

}  // namespace skein
