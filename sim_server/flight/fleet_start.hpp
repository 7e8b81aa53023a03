// What the seed decides about each UAV before the mission begins. Seed 0 decides nothing: the nominal run.
// Frame: W.  Units: m, ticks.
//
// Drawn per UAV, from streams keyed by (seed, purpose, UAV):
//   "start_offset"     horizontal offset of the start, evenly in a disc of 0.2 m, such that all stay
//                      least_start_distance() apart;
//   "start_delay"      0 to 1 s from its first trajectory command until its motors start; until then commands wait,
//                      the newest replacing older ones;
//   "command_latency"  whether its commands take effect at once or one exchange later.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

struct UavStart {
  Isometry3d X_WB = Isometry3d::Identity();  ///< at rest on the ground
  Tick motor_delay = 0;
  bool late_commands = false;
};

/// Whether a vehicle at a pose touches the structure.
using TouchesStructure = std::function<bool(const VehicleConfig&, const Isometry3d& X_WB)>;

/// Whether the structure shuts in a place: see enclosure.hpp.
using IsEnclosed = std::function<bool(const Vector3d& p_WB)>;

/// @throws InputError if the ground station stands in the structure or is enclosed by it.
void check_station(const Scenario& scenario, const IsEnclosed& enclosed);

/// One start per UAV, in fleet order. Pure.
/// @throws InputError if a start in the scenario lies in the structure or is enclosed by it; it names the UAV.
std::vector<UavStart> draw_fleet_start(const Scenario& scenario, std::uint64_t seed, const TouchesStructure& touches,
                                       const IsEnclosed& enclosed);

}  // namespace skein::sim
