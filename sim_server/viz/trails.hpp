// Positions of each UAV in the last 60 s. Frame W [m]. Not thread-safe.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim::viz {

class Trails {
 public:
  static constexpr Tick kSpan = 60 * kTicksPerSecond;
  static constexpr Tick kPeriod = kTicksPerSecond / 2;  ///< between two positions

  explicit Trails(std::size_t uavs) : places_(uavs) {}

  /// Call it with increasing ticks. It ignores positions less than kPeriod after the last ones that it added.
  /// @returns whether positions were added.
  bool add(Tick tick, std::span<const UavView> uavs) {
    if (tick < due_) return false;
    due_ = tick + kPeriod;
    ticks_.push_back(tick);
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i].push_back(uavs[i].state.p_WB);
    for (; ticks_.front() < tick - kSpan; ticks_.pop_front()) {
      for (auto& places : places_) places.pop_front();
    }
    return true;
  }

  /// Positions of a UAV, oldest first.
  const std::deque<Vector3d>& of(UavIndex uav) const { return places_.at(uav); }

 private:
  Tick due_ = 0;
  std::deque<Tick> ticks_;  ///< times of the positions
  std::vector<std::deque<Vector3d>> places_;
};

}  // namespace skein::sim::viz
