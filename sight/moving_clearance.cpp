#include "sight/moving_clearance.hpp"

#include <algorithm>

namespace skein::sim {
namespace {

constexpr double kSlackM = 0.01;  ///< more than the rounding errors of single precision

}  // namespace

double MovingClearance::at(const RayScene& rays, const Vector3d& p_W) {
  const double reach_m = last_m_ < most_m_ ? last_m_ + (p_W - last_p_W_).norm() + kSlackM : most_m_;
  last_m_ = std::min(most_m_, rays.clearance(p_W, std::min(reach_m, most_m_)));
  last_p_W_ = p_W;
  return last_m_;
}

}  // namespace skein::sim
