// Faults that change the scenario's conditions for a time: wind that freshens, rain, less light.  Pure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/conditions.hpp"
#include "core/config/config_reader.hpp"
#include "core/faults/fault_plan.hpp"

namespace skein {

/// Indices of the faults that change conditions in the exchange at a tick, in the file's order.
std::vector<std::size_t> active_changes(const FaultPlan& plan, Tick tick);

/// The scenario's conditions with the changes of these faults. It reads their values anew: call it when they differ.
/// @param plan  checked: load_fault_plan() returns no other.   @param faults  as active_changes() returns them.
ConditionsConfig changed_conditions(const FaultPlan& plan, const Scenario& scenario,
                                    const std::vector<std::size_t>& faults);

/// Adds an error for each key of a ConditionsChange that cannot change in a run, and for each part that the scenario
/// has switched off and the change would switch on. The keys themselves and their ranges are checked by the reader.
/// @param path  of the change in its file.
void check_conditions_change(const ConfigNode& values, const Scenario& scenario, const std::string& path,
                             ConfigErrors& errors);

}  // namespace skein
