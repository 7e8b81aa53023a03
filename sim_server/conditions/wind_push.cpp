#include "sim_server/conditions/wind_push.hpp"

#include "core/vehicle/airframe.hpp"
#include "sim_server/flight/vehicle.hpp"

namespace skein::sim {

// For an offset p with the velocity v, the controller demands the acceleration -omega^2 p - 2 zeta omega v - ki s. In
// each of its steps, s grows by p.
WindPush::WindPush(const VehicleConfig& vehicle) : mass_kg_(mass_properties(vehicle).mass_kg) {
  const PositionControlConfig& control = vehicle.position_control;
  const Vector3d omega(control.omega_xy, control.omega_xy, control.omega_z);
  const Vector3d zeta(control.zeta_xy, control.zeta_xy, control.zeta_z);
  stiffness_ = omega.cwiseAbs2();
  damping_ = 2.0 * zeta.cwiseProduct(omega);
  integral_gain_ = {control.ki_xy, control.ki_xy, control.ki_z};
}

void WindPush::step(const Vector3d& force_W, double step_s) {
  v_W_ += step_s * (force_W / mass_kg_ - stiffness_.cwiseProduct(p_W_) - damping_.cwiseProduct(v_W_) -
                    integral_gain_.cwiseProduct(error_sum_));
  p_W_ += step_s * v_W_;
  const double limit_m = PositionController::kPositionSumLimit;
  error_sum_ = (error_sum_ + step_s / seconds(kControlTicks) * p_W_).cwiseMax(-limit_m).cwiseMin(limit_m);
}

}  // namespace skein::sim
