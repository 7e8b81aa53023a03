// Clearance of a moving body from the static structure. It is at most the previous clearance plus the distance moved
// since, which limits the range of each query. The results are those of RayScene::clearance(), limited to `most_m`.
// Frame W.   Units: m.   Threads: one.
#pragma once

#include "sight/ray_scene.hpp"

namespace skein::sim {

class MovingClearance {
 public:
  /// @param most_m  upper limit of the result: greater clearances count as this.
  explicit MovingClearance(double most_m) : most_m_(most_m), last_m_(most_m) {}

  /// Clearance of the body at its present place. @param rays  must have the same structure in all calls.
  double at(const RayScene& rays, const Vector3d& p_W);

 private:
  const double most_m_;
  Vector3d last_p_W_ = Vector3d::Zero();
  double last_m_;
};

}  // namespace skein::sim
