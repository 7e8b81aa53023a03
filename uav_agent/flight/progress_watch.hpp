// Whether a UAV gets on: it flies somewhere, or photographs what it had not, or not so well. Who does neither for long
// stands still, whatever it thinks it is doing.
// Frame W.   Units: m, s.   Threads: one.
#pragma once

#include <vector>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class ProgressWatch {
 public:
  static constexpr double kMovedM = 3.0;  ///< from where it has stood: less is none

  /// Once per exchange.   @param retreats  moving is no getting on: back out of a corner it goes, and into it again.
  void update(const PlannerInput& in, bool retreats = false);
  /// Time since it last got on [s].
  double still_s(Tick now) const { return seconds(now - since_); }
  /// Time since it last came from elsewhere, in whatever way [s].
  double here_s(Tick now) const { return seconds(now - here_since_); }
  /// As if it had got on: it has begun something else.
  void forgive(const PlannerInput& in);

 private:
  Vector3d stood_W_ = Vector3d::Zero(), here_W_ = Vector3d::Zero();
  Tick since_ = 0, here_since_ = 0;
  std::vector<double> best_;  ///< score by DetectedPoint::order
};

}  // namespace skein::agent
