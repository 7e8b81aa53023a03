// The captures that this UAV carries, by value: what the fleet would lose with the UAV, and what its routes promise.
// Units: SI; values in points of score.   Threads: one.   Deterministic.
#pragma once

#include <cstddef>

#include "uav_agent/api/goals.hpp"

namespace skein::agent {

class FlockCargo {
 public:
  /// Call it once per exchange. When some of the waiting captures are delivered, each counts as worth the same.
  /// @param gained  by how much the detections of this exchange raise the fleet's known qualities [points].
  /// @param undelivered  number of captures that the station has not acknowledged.
  void update(double gained, std::size_t undelivered);
  /// Notes the gain that the route of a decision promises [points/s]; 0: there is no route.
  void note(double rate);
  /// The value of the waiting captures, and a moving average of the promised gains.
  const Stake& stake() const { return stake_; }

 private:
  Stake stake_;
  std::size_t undelivered_ = 0;
};

}  // namespace skein::agent
