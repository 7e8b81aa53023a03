// Draws random structural members into tubes that a map calls free, and counts those that the LiDAR has not seen.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/sensing/sensed_space.hpp"

namespace skein::sensing {

inline constexpr double kServoPhaseS = 3.0;  ///< the servo approaches its stop: a whole sweep begins within a second

struct Tally {
  std::size_t drawn = 0, unseen = 0;

  void add(const Tally& other) {
    drawn += other.drawn;
    unseen += other.unseen;
  }
  /// One-sided 95 % bounds of the share unseen / drawn (Wilson and Hilferty's for the Poisson distribution).
  double upper_bound() const;
  double lower_bound() const;
};

/// Draws at least `draws` members, twenty for each free tube of 1 m length, in tubes up to 30 m from the LiDAR; fewer
/// only if hardly any tube is free. @returns tallies by distance from the route, in bins of 2 m.
std::vector<Tally> draw_members(const SensedSpace& space, RandomStream& random, std::size_t draws);

Tally sum(const std::vector<Tally>& by_distance);
/// Moves the tally of each bin with too few members for a bound to the next nearer bin.
std::vector<Tally> merged(std::vector<Tally> by_distance);

}  // namespace skein::sensing
