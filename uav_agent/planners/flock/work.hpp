// How much work this UAV has: the gain that its routes promise, and how short work is for the fleet.
// Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <cstddef>
#include <vector>

#include "uav_agent/planners/flock/views.hpp"

namespace skein::agent {

class FlockWork {
 public:
  static constexpr double kRateShare = 0.15;  ///< weight of a new decision in moving averages of gains; chosen

  /// Notes the gain that the route of a decision promises [points/s].
  void note(double rate);
  /// Moving average of the gain that the UAV's routes promise [points/s].
  double rate() const { return rate_; }
  /// How short work is, from 0 to 1, which decides what surveying is worth to an explorer. The greater of two numbers:
  /// the share of what the fleet can photograph in the remaining time that is not found yet; and the relative loss of
  /// the gain per second that routes promise, compared with the best so far.
  /// @param others  the gains that other UAVs promise [points/s].   @param left_s  remaining time of the mission.
  double lack(const std::vector<double>& others, const FlockTargets& targets, double left_s, std::size_t uavs) const;

 private:
  /// Gain that a route promises where there are enough points [points/s]. Chosen.
  static constexpr double kGoodRate = 3.0;

  double rate_ = 0.0, best_rate_ = kGoodRate;
};

}  // namespace skein::agent
