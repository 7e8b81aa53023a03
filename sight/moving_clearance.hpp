// Distance of something that moves from the structure, which stands still: no farther than last time and what it has
// moved since, so a query need not look beyond; the answers are those of RayScene::clearance().
// Frame W.   Units: m.   Threads: one.
#pragma once

#include "sight/ray_scene.hpp"

namespace skein::sim {

class MovingClearance {
 public:
  /// @param most_m  what is not nearer counts as so far away
  explicit MovingClearance(double most_m) : most_m_(most_m), last_m_(most_m) {}

  double at(const RayScene& rays, const Vector3d& p_W);

 private:
  const double most_m_;
  Vector3d last_p_W_ = Vector3d::Zero();
  double last_m_;
};

}  // namespace skein::sim
