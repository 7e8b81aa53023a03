// How far a LiDAR in empty space proves a way to be free, by the thinnest member that is not to be missed, and how fast
// a UAV may fly to be able to stop within that distance.
// Frame W.   Units: SI.   Deterministic.
#pragma once

#include <span>
#include <vector>

namespace skein::bench {

/// How long a way from the UAV straight on a tube of the body's radius and kHaloM is free.
struct Reach {
  double member_width_m = 0.05;
  double one_sweep_m = 0.0, one_sweep_least_m = 0.0;        ///< hovering for one period of the servo: level ways
  double three_sweeps_m = 0.0, three_sweeps_least_m = 0.0;  ///< the same for three
  double ahead_m = 0.0, ahead_least_m = 0.0;                ///< flying straight on at kAheadMps: the way that it flies
};
inline constexpr double kAheadMps = 2.0;

/// Medians, and the least, over level directions and over the flight. One flight for all widths.
std::vector<Reach> reaches(const std::vector<double>& member_widths_m, std::uint64_t seed);

/// How far the explorer gets from the exchange in which its planner says Hold until it is at rest.
struct Stop {
  double speed_mps = 0.0, way_m = 0.0;
};
/// Flown, each half a metre a second up to the vehicle's limit. @param seed  draws whether commands are late.
std::vector<Stop> stops(std::uint64_t seed);

/// The highest speed from which it stops within a distance, by the stops and between them; at most their last.
double speed_within(std::span<const Stop> stops, double way_m);

}  // namespace skein::bench
