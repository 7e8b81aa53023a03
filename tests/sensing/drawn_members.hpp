// Members that are drawn into tubes which a map calls free, and how many of them the LiDAR has not seen.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/sensing/sensed_space.hpp"

namespace skein::sensing {

inline constexpr double kServoPhaseS = 3.0;  ///< on its way to the stop: a whole sweep begins within a second

struct Tally {
  std::size_t drawn = 0, unseen = 0;

  void add(const Tally& other) {
    drawn += other.drawn;
    unseen += other.unseen;
  }
  /// One-sided 95 % bounds of the share (Wilson and Hilferty's of the Poisson distribution).
  double upper_bound() const;
  double lower_bound() const;
};

/// By distance from the route, in steps of 2 m: so many members, twenty to a tube of 1 m, of tubes up to 30 m away.
/// Fewer only where hardly a tube is free.
std::vector<Tally> draw_members(const SensedSpace& space, RandomStream& random, std::size_t draws);

Tally sum(const std::vector<Tally>& by_distance);
/// What is too rare for a bound goes to the next nearer one.
std::vector<Tally> merged(std::vector<Tally> by_distance);

}  // namespace skein::sensing
