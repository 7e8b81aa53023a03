// How a UAV flies, whatever its strategy: all values of the flight core that are choices. Strategies take them beside
// their own parameters (--planner patrol:approach_mps=3), so `skein compare` can sweep them.
// Units: SI and radians unless the name says otherwise.
#pragma once

#include "core/config/config_reader.hpp"

namespace skein::agent {

struct FlightConfig {
  // Safety. What must be free about a body is its radius, kHaloM (maps/free_evidence.hpp) and the tracking error.
  double error_m = 0.33;          ///< tracking error at rest, with a LiDAR; docs/flight-safety.md has the measurement
  double light_error_m = 0.23;    ///< the same without one
  double error_per_mps_s = 0.03;  ///< and so much more a metre a second
  double tight_halo_m = 0.35;     ///< about the body, in place of kHaloM, where a UAV was put down with less room
  double tight_mps = 0.8;         ///< no faster then
  double ground_m = 1.0;          ///< below, nothing is asked of the map: the ground is level, at z = 0
  double floor_m = 2.0;           ///< nobody flies lower, except at takeoff
  double peer_margin_m = 0.6;     ///< between two bodies when both have braked
  double peer_memory_s = 20.0;    ///< a UAV that went out of sight is taken to be where it came to rest for so long

  // Motion.
  double approach_mps = 5.0;  ///< from here to there; the map decides how much of it can be had
  double climb_mps = 3.0;
  double sweep_s = 4.0;       ///< the LiDAR sees all directions in so long: no faster than through what is proved in it
  double unknown_cost = 1.5;  ///< of a metre through space that is not known, in metres

  // When something comes to nothing.
  double stall_s = 4.0;     ///< no way is gained for so long: the goal is given up, or the UAV looks around
  double look_s = 8.0;      ///< the LiDAR has looked in all directions: a period of its servo
  double refused_s = 40.0;  ///< a place that could not be proved is left out of ways for so long
  double alone_s = 45.0;    ///< a UAV without a LiDAR that is told of no free space for so long takes boxes to be all
  double alone_mps = 1.5;   ///< ...and flies no faster then
  double yield_s = 5.0;     ///< a UAV waits for one of lower number for so long

  // What it makes of what it is told of odometry, wind and battery (caution.hpp).
  bool reacts = true;
  double drift_sigmas = 2.0;     ///< of the told position that are kept off structure and UAVs
  double wind_error_s = 0.03;    ///< tracking error for each m/s of wind
  double gust_slows_s_m = 0.15;  ///< share of approach_mps that each m/s of gusts costs, beyond the first
  double land_mps = 1.0;         ///< down to the ground

  // Bringing captures home.
  double deliver_every_s = 240.0;
  double return_margin_s = 12.0;

  template <class R>
  void describe(R& r) {
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
