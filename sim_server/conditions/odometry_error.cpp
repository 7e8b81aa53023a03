#include "sim_server/conditions/odometry_error.hpp"

#include <cmath>

#include "core/math/euler.hpp"
#include "core/math/normals.hpp"

namespace skein::sim {

void GaussMarkov::step(double keeps, RandomStream& draw) {
  const double fresh = 1.0 - keeps * keeps;
  value_ = keeps * value_ + std::sqrt(fresh) * draw.normal();
  variance_ = keeps * keeps * variance_ + fresh;
}

OdometryError::OdometryError(const OdometryConditions& config, std::uint64_t seed, UavIndex uav)
    : config_(config),
      draw_(seed, "odometry_error", uav),
      noise_draw_(seed, "odometry_noise", uav),
      bias_m_(config.bias_sigma_m * normals(draw_)),
      x_(first_error()),
      y_(first_error()),
      z_(first_error()),
      yaw_(draw_),
      at_start_(config.known_start) {
  turn();
  if (config_.mean_fix_s) until_change_s_ = draw_duration(*config_.mean_fix_s);
  draw_noise();
}

Vector3d OdometryError::with_fix_m() const {
  return bias_m_ + Vector3d(config_.horizontal_sigma_m * x_.value(), config_.horizontal_sigma_m * y_.value(),
                            config_.vertical_sigma_m * z_.value());
}

Vector3d OdometryError::position_error_m() const { return lost_ ? walked_m_ : with_fix_m(); }
double OdometryError::yaw_error() const { return config_.yaw_sigma_deg * kRadPerDeg * yaw_.value(); }

/// Call it when yaw_error() changes: the flight controller asks for believed() far more often.
void OdometryError::turn() { yaw_turn_ = Eigen::AngleAxisd(yaw_error(), Vector3d::UnitZ()); }

void OdometryError::step(double step_s) {
  yaw_.step(std::exp(-step_s / config_.yaw_time_constant_s), draw_);
  turn();
  if (at_start_) return;
  const double keeps = std::exp(-step_s / config_.time_constant_s);
  for (GaussMarkov* axis : {&x_, &y_, &z_}) axis->step(keeps, draw_);
  if (lost_) {
    lost_s_ += step_s;
    walked_m_ += config_.walk_m_per_sqrt_s * std::sqrt(step_s) * normals(draw_);
  }
  if (!config_.mean_fix_s || jammed_) return;
  until_change_s_ -= step_s;
  if (until_change_s_ > 0.0) return;
  if (lost_) {
    lost_ = false;
  } else {
    lose_fix();
  }
  until_change_s_ = draw_duration(lost_ ? config_.mean_lost_s : *config_.mean_fix_s);
}

void OdometryError::lose_fix() {
  walked_m_ = with_fix_m();
  variance_when_lost_ = x_.variance();
  horizontal_sigma_when_lost_m_ = config_.horizontal_sigma_m;
  vertical_sigma_when_lost_m_ = config_.vertical_sigma_m;
  lost_s_ = walked_before_m2_ = 0.0;
  lost_ = true;
}

void OdometryError::jam(bool jammed) {
  if (jammed == jammed_) return;
  jammed_ = jammed;
  if (jammed) {
    if (!lost_) lose_fix();
    return;
  }
  lost_ = false;
  if (config_.mean_fix_s) until_change_s_ = draw_duration(*config_.mean_fix_s);
}

void OdometryError::change(const OdometryConditions& config) {
  if (lost_) {
    walked_before_m2_ += config_.walk_m_per_sqrt_s * config_.walk_m_per_sqrt_s * lost_s_;
    lost_s_ = 0.0;
  }
  config_ = config;
  turn();
}

void OdometryError::draw_noise() {
  noise_m_ = config_.noise_sigma_m * normals(noise_draw_);
  velocity_noise_mps_ = config_.velocity_sigma_mps * normals(noise_draw_);
}

RigidBodyState OdometryError::believed(const RigidBodyState& truth) const {
  RigidBodyState state = truth;
  state.p_WB += position_error_m();
  state.q_WB = yaw_turn_ * truth.q_WB;
  return state;
}

RigidBodyState OdometryError::told(const RigidBodyState& truth) const {
  RigidBodyState state = believed(truth);
  state.p_WB += noise_m_;
  state.v_WB += velocity_noise_mps_;
  return state;
}

PoseUncertainty OdometryError::uncertainty() const {
  const double walk_m = lost_ ? config_.walk_m_per_sqrt_s * std::sqrt(lost_s_) : 0.0;
  const double variance = lost_ ? variance_when_lost_ : x_.variance();  // the three axes have the same
  const auto deviation = [&](double sigma_m) {
    return std::sqrt(variance * sigma_m * sigma_m + config_.bias_sigma_m * config_.bias_sigma_m +
                     config_.noise_sigma_m * config_.noise_sigma_m + walk_m * walk_m +
                     (lost_ ? walked_before_m2_ : 0.0));
  };
  const double horizontal_m = deviation(lost_ ? horizontal_sigma_when_lost_m_ : config_.horizontal_sigma_m);
  const double vertical_m = deviation(lost_ ? vertical_sigma_when_lost_m_ : config_.vertical_sigma_m);
  return {{horizontal_m, horizontal_m, vertical_m}, config_.yaw_sigma_deg * kRadPerDeg, config_.velocity_sigma_mps};
}

}  // namespace skein::sim
