// Drawn faults of the conditions (docs/conditions.md): gusts, a lost position fix, a battery that loses charge, weather
// that turns. A run can have such a fault only if the part that the fault changes is on in the run's conditions.
// The same stream draws the same faults. Pure; any thread.
#pragma once

#include <string>

#include "core/faults/fault_plan.hpp"
#include "core/math/random_stream.hpp"
#include "core/scenario/conditions.hpp"

namespace skein::cli {

/// Whether a run under these conditions can have faults of this kind (fault_kind()).
bool is_possible(const std::string& kind, const ConditionsConfig& conditions);
/// Whether a run under these conditions can have this fault.
bool is_possible(const Fault& fault, const ConditionsConfig& conditions);

/// Draws a fault of a kind that is_possible(): "gust", "fix_loss", "battery_loss" or "conditions". Vehicles withstand
/// the fault: mean wind and gust together stay below 12 m/s (in stronger wind, a gust stays below 2 m/s), and a battery
/// keeps enough charge to fly home.
FaultAction weather_fault(const std::string& kind, const std::string& uav, const ConditionsConfig& conditions,
                          RandomStream& draw);

}  // namespace skein::cli
