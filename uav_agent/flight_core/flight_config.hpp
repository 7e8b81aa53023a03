// Parameters of the flight core, which are the same for every strategy. Users set them beside the planner's own
// parameters (--planner patrol:approach_mps=3), so `skein compare` can sweep them.
// Units: SI and radians unless the name says otherwise.
#pragma once

#include "core/config/config_reader.hpp"

namespace skein::agent {

struct FlightConfig {
  // Safety. A sphere about the UAV must be free. Its radius is the sum of the body's radius, kHaloM
  // (maps/free_evidence.hpp) and the tracking error.
  double error_m = 0.33;          ///< tracking error at rest of a UAV with a LiDAR; measured in docs/flight-safety.md
  double light_error_m = 0.23;    ///< the same for a UAV without a LiDAR
  double error_per_mps_s = 0.03;  ///< additional tracking error per m/s of speed
  double tight_halo_m = 0.35;     ///< replaces kHaloM at a start with less room, and on the UAV's own trail
  double tight_mps = 0.8;         ///< maximum speed while tight_halo_m counts
  double ground_m = 1.0;          ///< the map need not prove space below this height: the ground is level, at z = 0
  double floor_m = 2.0;           ///< lowest height of a planned path, unless the UAV is lower already
  double peer_margin_m = 0.6;     ///< between the bodies of two UAVs that have both braked
  double peer_memory_s = 20.0;    ///< for so long, a UAV out of sight is avoided: it counts as braking or at rest

  // Motion.
  double approach_mps = 5.0;  ///< speed on the path to a goal; lower where little space ahead is proved
  double climb_mps = 3.0;     ///< speed of climbs
  double sweep_s = 4.0;  ///< time in which the LiDAR sees all directions; speed limit: proved length ahead / sweep_s
  double unknown_cost = 1.5;  ///< path cost of a metre through unknown space, in metres of free space

  // When something fails.
  double stall_s = 4.0;     ///< without progress for so long, the UAV looks around, replans, or ends the goal
  double look_s = 8.0;      ///< duration of looking around: one period of the LiDAR's servo
  double refused_s = 40.0;  ///< for so long, paths avoid a place that could not be proved free
  double alone_s = 45.0;    ///< so long a UAV without a working LiDAR waits for map updates (sight.hpp)
  double alone_mps = 1.5;   ///< maximum speed of a UAV that assumes that space outside the boxes is free
  double yield_s = 5.0;     ///< so much longer than stall_s, a UAV waits for one with a lower index

  /// A UAV that has been held at one place for so long has looked around, waited for others, and searched other paths.
  double held_s() const { return stall_s + look_s + yield_s; }

  // Reactions to the uncertainty of the odometry, to wind and to the battery (caution.hpp).
  bool reacts = true;            ///< false: no reactions
  double drift_sigmas = 2.0;     ///< standard deviations of the position, added to clearances
  double wind_error_s = 0.03;    ///< additional tracking error per m/s of wind
  double gust_slows_s_m = 0.15;  ///< share of approach_mps lost per m/s of gusts beyond 1 m/s
  double land_mps = 1.0;         ///< sinking speed of a landing

  // Return to the station, to deliver captures (homing.hpp).
  double deliver_every_s = 240.0;  ///< longest time for which a UAV works on with undelivered captures
  double return_margin_s = 12.0;   ///< time to spare between the arrival at a link and the end of the mission

  void describe(auto& r) {
    r.field("error_m", error_m, within(0.0, 2.0));
    r.field("light_error_m", light_error_m, within(0.0, 2.0));
    r.field("error_per_mps_s", error_per_mps_s, within(0.0, 1.0));
    r.field("tight_halo_m", tight_halo_m, within(0.1, 1.0));
    r.field("tight_mps", tight_mps, within(0.1, 5.0));
    r.field("ground_m", ground_m, within(0.0, 5.0));
    r.field("floor_m", floor_m, within(1.0, 20.0));
    r.field("peer_margin_m", peer_margin_m, within(0.1, 10.0));
    r.field("peer_memory_s", peer_memory_s, within(0.0, 600.0));
    r.field("approach_mps", approach_mps, within(0.5, 20.0));
    r.field("climb_mps", climb_mps, within(0.2, 10.0));
    r.field("sweep_s", sweep_s, within(0.1, 60.0));
    r.field("unknown_cost", unknown_cost, within(1.0, 10.0));
    r.field("stall_s", stall_s, within(1.0, 60.0));
    r.field("look_s", look_s, within(1.0, 60.0));
    r.field("refused_s", refused_s, within(1.0, 600.0));
    r.field("alone_s", alone_s, within(1.0, 1e6));
    r.field("alone_mps", alone_mps, within(0.1, 20.0));
    r.field("yield_s", yield_s, within(0.0, 60.0));
    r.field("reacts", reacts);
    r.field("drift_sigmas", drift_sigmas, within(0.0, 6.0));
    r.field("wind_error_s", wind_error_s, within(0.0, 1.0));
    r.field("gust_slows_s_m", gust_slows_s_m, within(0.0, 2.0));
    r.field("land_mps", land_mps, within(0.2, 3.0));
    r.field("deliver_every_s", deliver_every_s, within(10.0, 1e6));
    r.field("return_margin_s", return_margin_s, within(0.0, 600.0));
  }
};

}  // namespace skein::agent
