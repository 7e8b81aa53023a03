// Parameters of the flight core. Every strategy that uses the flight core accepts those that affect it. Users set them
// together with the planner's own parameters (--planner patrol:approach_mps=3), so `skein compare` can sweep them.
// Units: SI and radians unless the name says otherwise.
#pragma once

#include "core/config/config_reader.hpp"

namespace skein::agent {

/// A UAV that begins above this height was restarted in flight. Chosen.
inline constexpr double kBeginsInFlightM = 2.0;
/// A UAV with a working LiDAR flies at least at kCreepMps, even if little of the path ahead is proved free. It examines
/// the path ahead in steps of at most kProvedStepM. Chosen.
inline constexpr double kCreepMps = 0.5, kProvedStepM = 1.0;
/// A UAV that is farther from its start has left it. Chosen.
inline constexpr double kLeftStartM = 2.5;
/// A UAV that moves no farther has stayed where it is: it has made no progress, and counts as standing. Chosen.
inline constexpr double kStaysM = 0.5;

struct FlightConfig {
  // Safety. A sphere around the UAV must be proved free. Its radius is the sum of the body's radius, kHaloM
  // (maps/free_evidence.hpp) and the tracking error.
  double error_m = 0.33;          ///< tracking error of an explorer at rest; docs/flight-safety.md has the measurement
  double light_error_m = 0.23;    ///< the same for a photographer
  double error_per_mps_s = 0.03;  ///< additional tracking error per m/s of speed
  /// Replaces kHaloM at a start with less room, on the UAV's own trail, and for a UAV that must land at once; for the
  /// latter also peer_margin_m.
  double tight_halo_m = 0.35;
  double tight_mps = 0.8;  ///< maximum speed at such a start, on the trail, and while a UAV moves aside
  double ground_m = 1.0;   ///< the map need not prove space below this height: the ground is level, at z = 0
  /// Lowest height of a planned path. For a UAV below it, the limit is the UAV's own height, but at least floor_m / 2.
  double floor_m = 2.0;
  double peer_margin_m = 0.6;  ///< minimum gap between the bodies of two UAVs after both have braked
  /// Time for which this UAV avoids a UAV that is out of sight, as if that UAV had braked when it was last seen.
  double peer_memory_s = 20.0;

  // Motion.
  double approach_mps = 5.0;  ///< speed on the path to a goal; lower where only little space ahead is proved free
  double climb_mps = 3.0;     ///< speed of climbs
  /// A UAV with a LiDAR flies no faster than it would cover the proved length of the path ahead in this time. Chosen by
  /// the score (docs/flight-core.md); the safety filter does not rely on it.
  double ahead_s = 1.5;
  double unknown_cost = 1.5;  ///< cost of a metre through unproved space, in metres through proved space

  // When something fails.
  double stall_s = 4.0;     ///< time without progress after which the UAV looks around, replans, or gives up its goal
  double look_s = 8.0;      ///< duration of looking around: one period of the LiDAR's servo
  double refused_s = 40.0;  ///< time for which paths avoid a place where structure or unproved space stopped the UAV
  /// Time for which a UAV without a working LiDAR waits for map updates before it assumes that space outside the boxes
  /// is free (sight.hpp).
  double alone_s = 45.0;
  double alone_mps = 1.5;  ///< maximum speed of a UAV that assumes this
  /// Additional time, after stall_s, for which a UAV waits for a UAV with a lower index that is in its way.
  double yield_s = 5.0;

  /// A UAV that has been stopped at one place for this time has looked around, waited for others, and searched other
  /// paths.
  double held_s() const { return stall_s + look_s + yield_s; }

  // Reactions to the uncertainty of the odometry, to wind and to the battery (caution.hpp).
  bool reacts = true;          ///< false: no reactions
  double drift_sigmas = 2.0;   ///< clearances grow by this number of standard deviations of the position
  double wind_error_s = 0.03;  ///< additional tracking error per m/s of mean wind
  /// Per m/s of gusts above 1 m/s, the speed limit drops by this share of approach_mps, but never below half of it.
  double gust_slows_s_m = 0.15;
  double land_mps = 1.0;  ///< vertical speed of a landing

  // Return to the station, to deliver captures (homing.hpp).
  /// If the planner does not state its stake (PlannerOutput::stake): maximum time for which a UAV continues its work
  /// with undelivered captures. For all planners: time for which a UAV works on after it found no place with a link.
  double deliver_every_s = 240.0;
  /// If the planner states its stake: expected losses of a UAV in an hour of flight. 0: no delivery before the one at
  /// the mission's end.
  double hazard_per_h = 1.0;
  /// Planned time between the arrival at a place with a link and the end of the mission.
  double return_margin_s = 12.0;

  void describe(auto& r) {
    describe_by_time(r);
    r.field("hazard_per_h", hazard_per_h, within(0.0, 3600.0));
  }
  /// The parameters of a planner that does not state the value of its captures (PlannerOutput::stake).
  void describe_by_time(auto& r) {
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
    r.field("ahead_s", ahead_s, within(0.1, 60.0));
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
