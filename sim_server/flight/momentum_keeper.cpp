#include "sim_server/flight/momentum_keeper.hpp"

namespace skein::sim {

MomentumKeeper::MomentumKeeper(const Vector3d& inertia, const Matrix3d& R_WP, const Vector3d& w_WP_W, double step_s)
    : inertia_(inertia), R_WP_(R_WP), L_W_(momentum(R_WP, w_WP_W)) {
  const double half_turn = 0.5 * step_s * w_WP_W.norm();
  const Matrix3d R_WM =
      half_turn > 0.0 ? Matrix3d(Eigen::AngleAxisd(half_turn, w_WP_W.normalized()).toRotationMatrix() * R_WP_) : R_WP_;
  w_middle_W_ = velocity(R_WM, L_W_);
}

Vector3d MomentumKeeper::finish(const Matrix3d& R_WP, const Vector3d& w_WP_W) {
  L_W_ += momentum(R_WP_, w_WP_W - w_middle_W_);
  return velocity(R_WP, L_W_);
}

Vector3d MomentumKeeper::momentum(const Matrix3d& R_WP, const Vector3d& w_W) const {
  return R_WP * inertia_.cwiseProduct(R_WP.transpose() * w_W);
}

Vector3d MomentumKeeper::velocity(const Matrix3d& R_WP, const Vector3d& L_W) const {
  return R_WP * (R_WP.transpose() * L_W).cwiseQuotient(inertia_);
}

}  // namespace skein::sim
