// Faults that change the scenario's conditions for a time: wind that freshens, rain, less light.  Pure.
#pragma once

#include <optional>
#include <string>

#include "core/conditions.hpp"
#include "core/config/config_reader.hpp"
#include "core/faults/fault_plan.hpp"

namespace skein {

/// The conditions in the exchange at a tick: the scenario's, with the changes of all active faults in the file's order.
/// nullopt if no fault changes them.
/// @param plan  checked: load_fault_plan() returns no other.
std::optional<ConditionsConfig> changed_conditions(const FaultPlan& plan, const Scenario& scenario, Tick tick);

/// Adds an error for each key of a ConditionsChange that cannot change in a run, and for each part that the scenario
/// has switched off and the change would switch on. The keys themselves and their ranges are checked by the reader.
/// @param path  of the change in its file.
void check_conditions_change(const ConfigNode& values, const Scenario& scenario, const std::string& path,
                             ConfigErrors& errors);

}  // namespace skein
