// Random start conditions of each UAV, drawn from the run's seed. With seed 0, the nominal run, none are drawn.
// Frame: W.  Units: m, ticks.
//
// Drawn per UAV, from streams keyed by (seed, purpose, UAV):
//   "start_offset"     horizontal offset of the start, uniform in a disc of radius 0.2 m, such that all UAVs stay
//                      least_start_distance() apart and clear of structure; no offset if 100 draws fail;
//   "start_delay"      time from the first trajectory command until the motors start, uniform in 0 to 1 s; until then
//                      commands wait, and a newer one replaces an older one;
//   "command_latency"  whether commands take effect at once or one exchange later, with equal probability.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

struct UavStart {
  Isometry3d X_WB = Isometry3d::Identity();  ///< pose at rest on the ground
  Tick motor_delay = 0;
  bool late_commands = false;
};

/// Whether a vehicle at this pose would touch the structure.
using TouchesStructure = std::function<bool(const VehicleConfig&, const Isometry3d& X_WB)>;

/// Whether the structure encloses a place, so that no line of sight leads out (enclosure.hpp).
using IsEnclosed = std::function<bool(const Vector3d& p_WB)>;

/// @throws InputError if the ground station stands in the structure or is enclosed by it.
void check_station(const Scenario& scenario, const IsEnclosed& enclosed);

/// Draws one start per UAV, in fleet order. Pure.
/// @throws InputError if a start in the scenario touches the structure or is enclosed by it; the message names the UAV.
std::vector<UavStart> draw_fleet_start(const Scenario& scenario, std::uint64_t seed, const TouchesStructure& touches,
                                       const IsEnclosed& enclosed);

}  // namespace skein::sim
