// Up to which distance a LiDAR in empty space proves a straight path to be free, depending on the thinnest member that
// must not be missed; and how fast a UAV may fly so that it can stop within that distance.
// Frame W.   Units: SI.   Deterministic.
#pragma once

#include <span>
#include <vector>

namespace skein::bench {

/// Free distance: length of the straight tube from the UAV that is proved free. Its radius is the body's plus kHaloM.
struct Reach {
  double member_width_m = 0.05;                             ///< thinnest member that must not be missed
  double one_sweep_m = 0.0, one_sweep_least_m = 0.0;        ///< after a hover of one servo period, in level directions
  double three_sweeps_m = 0.0, three_sweeps_least_m = 0.0;  ///< the same after three periods
  double ahead_m = 0.0, ahead_least_m = 0.0;                ///< ahead, in straight flight at kAheadMps
};
inline constexpr double kAheadMps = 2.0;

/// Medians and minima: of a hover over level directions, of the straight flight over time. One flight for all widths.
/// @throws std::runtime_error if the explorer crashes.
std::vector<Reach> reaches(const std::vector<double>& member_widths_m, std::uint64_t seed);

/// Stopping distance: how far the explorer gets, until it rests, from its position when its planner commands Hold.
struct Stop {
  double speed_mps = 0.0, way_m = 0.0;
};
/// Measured in flight, at speeds in steps of 0.5 m/s up to the vehicle's maximum. @param seed  of the random delays of
/// commands. @throws std::runtime_error if the explorer crashes.
std::vector<Stop> stops(std::uint64_t seed);

/// The highest speed from which the explorer stops within a distance, interpolated linearly between the stops; at most
/// the speed of the last one. @param stops  by ascending speed.
double speed_within(std::span<const Stop> stops, double way_m);

}  // namespace skein::bench
