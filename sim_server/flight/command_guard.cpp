#include "sim_server/flight/command_guard.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/math/euler.hpp"
#include "core/math/vectors.hpp"
#include "core/text/text.hpp"

namespace skein::sim {
namespace {

constexpr double kStepS = 0.05;        ///< of the control law
constexpr double kRounding = 1e-6;     ///< a command may exceed a limit by this share
constexpr double kGiven = 0.01;        ///< shorter vectors mean "none" to the control law
constexpr double kBrakingShare = 0.8;  ///< of the maximum acceleration; the rest is for the law's integral term
constexpr double kTiny = 1e-9;         ///< avoids divisions by zero

std::string beyond(const char* what, double value, double limit, const char* unit) {
  return std::string(what) + " of " + significant(value, 4) + " " + unit + " is beyond the vehicle's limit of " +
         significant(limit, 4) + " " + unit;
}

/// Whether the vector is finite, and its length too: in 64 bits, squares overflow from 1e154 on.
bool has_length(const Vector3d& v) { return std::isfinite(v.squaredNorm()); }

bool given(const Vector3d& v) { return v.norm() >= kGiven; }

}  // namespace

CommandGuard::CommandGuard(const VehicleConfig& vehicle, const RulesConfig& rules)
    : reject_(rules.reject_commands_beyond_limits),
      guard_(rules.guard_position_commands),
      max_speed_(vehicle.max_speed_mps),
      max_acceleration_(vehicle.max_acceleration_mps2),
      max_yaw_rate_(vehicle.max_yaw_rate_deg_s * kRadPerDeg) {
  const PositionControlConfig& law = vehicle.position_control;
  const Vector3d omega(law.omega_xy, law.omega_xy, law.omega_z);
  const Vector3d zeta(law.zeta_xy, law.zeta_xy, law.zeta_z);
  stiffness_ = omega.cwiseProduct(omega).cwiseMax(kTiny);  // a vehicle's gains may be 0
  damping_ = 2.0 * omega.cwiseProduct(zeta).cwiseMax(kTiny);
}

std::optional<std::string> CommandGuard::refuse(const TrajectoryCommand& command, const RigidBodyState& state) const {
  if (!has_length(command.p_WB) || !has_length(command.v_WB) || !has_length(command.a_WB) ||
      !std::isfinite(command.yaw) || !std::isfinite(command.yaw_rate)) {
    return "a setpoint must consist of finite numbers below 1e154";
  }
  if (!reject_) return std::nullopt;
  const double speed = command.v_WB.norm(), acceleration = command.a_WB.norm();
  const double yaw_rate = std::abs(command.yaw_rate);
  if (speed > max_speed_ * (1.0 + kRounding)) return beyond("a velocity", speed, max_speed_, "m/s");
  if (acceleration > max_acceleration_ * (1.0 + kRounding)) {
    return beyond("an acceleration", acceleration, max_acceleration_, "m/s^2");
  }
  if (yaw_rate > max_yaw_rate_ * (1.0 + kRounding)) {
    return beyond("a yaw rate", yaw_rate / kRadPerDeg, max_yaw_rate_ / kRadPerDeg, "deg/s");
  }
  const bool bare_acceleration = !given(command.p_WB) && !given(command.v_WB) && given(command.a_WB);
  if (bare_acceleration && state.v_WB.dot(command.a_WB) > 0.0) {
    const double next_speed = (state.v_WB + command.a_WB * kStepS).norm();
    if (next_speed > max_speed_) {
      return beyond("an acceleration that leads to a speed", next_speed, max_speed_, "m/s");
    }
  }
  return std::nullopt;
}

double CommandGuard::limit_yaw_rate(double demanded) const {
  return guard_ ? std::clamp(demanded, -max_yaw_rate_, max_yaw_rate_) : demanded;
}

TrajectoryCommand CommandGuard::lead(const TrajectoryCommand& command, const RigidBodyState& state) {
  if (!guard_ || !given(command.p_WB)) {
    carrot_.reset();
    return command;
  }
  const bool within = within_limits(command, state);
  if (!carrot_) {
    if (within) return command;
    carrot_ = launch(command, state);
  } else {
    move_carrot(command);
  }
  hold_carrot_back(command, state);
  TrajectoryCommand led = command;
  led.p_WB = carrot_->p_W;
  if (within && carrot_->p_W == command.p_WB) carrot_.reset();
  return led;
}

/// The law's acceleration due to the UAV's own velocity if no velocity is commanded; else 0.
Vector3d CommandGuard::damping(const TrajectoryCommand& command, const RigidBodyState& state) const {
  return given(command.v_WB) ? Vector3d::Zero().eval() : Vector3d(-damping_.cwiseProduct(state.v_WB));
}

/// The law's acceleration for a commanded position.
Vector3d CommandGuard::demand(const Vector3d& p_W, const TrajectoryCommand& command,
                              const RigidBodyState& state) const {
  return stiffness_.cwiseProduct(p_W - state.p_WB) + damping(command, state);
}

bool CommandGuard::within_limits(const TrajectoryCommand& command, const RigidBodyState& state) const {
  // Difference of velocities at which the UAV would keep its present distance from a moving position.
  const Vector3d closing = stiffness_.cwiseQuotient(damping_).cwiseProduct(command.p_WB - state.p_WB);
  return demand(command.p_WB, command, state).norm() <= max_acceleration_ &&
         (command.v_WB + closing).norm() <= max_speed_;
}

CommandGuard::Carrot CommandGuard::launch(const TrajectoryCommand& command, const RigidBodyState& state) const {
  // The carrot begins with the position and velocity that it would have if the UAV had been following it all the time,
  // with the acceleration that the law demands now (within the limit): so a UAV under way neither jerks nor flies on.
  const Vector3d lag = damping_.cwiseQuotient(stiffness_);  // by which a UAV lags behind what it follows [s]
  Vector3d a = shortened(demand(command.p_WB, command, state), max_acceleration_);
  const Vector3d v = shortened(state.v_WB + lag.cwiseProduct(a), max_speed_);
  a = shortened((v - state.v_WB).cwiseQuotient(lag), max_acceleration_);
  return {state.p_WB + lag.cwiseProduct(state.v_WB - command.v_WB) + a.cwiseQuotient(stiffness_), v};
}

void CommandGuard::move_carrot(const TrajectoryCommand& command) {
  const Vector3d to_target = command.p_WB - carrot_->p_W;
  const double distance = to_target.norm();
  const double approach = std::min(stopping_speed(distance), distance / kStepS);
  const Vector3d wanted = shortened(command.v_WB + to_target * (approach / std::max(distance, kTiny)), max_speed_);
  const double speed_step = max_acceleration_ * kStepS;
  if (distance <= speed_step * kStepS && (carrot_->v_W - command.v_WB).norm() <= speed_step) {
    carrot_ = Carrot{command.p_WB, command.v_WB};
    return;
  }
  carrot_->v_W += shortened(wanted - carrot_->v_W, speed_step);
  carrot_->p_W += carrot_->v_W * kStepS;
}

/// Pulls the carrot back towards a UAV that lags behind, so that the law does not exceed the permitted acceleration.
void CommandGuard::hold_carrot_back(const TrajectoryCommand& command, const RigidBodyState& state) {
  const Vector3d a = demand(carrot_->p_W, command, state);
  if (a.norm() <= max_acceleration_) return;
  carrot_->p_W = state.p_WB + (shortened(a, max_acceleration_) - damping(command, state)).cwiseQuotient(stiffness_);
}

/// The speed from which the carrot can still stop within a distance if it begins to brake one step from now.
double CommandGuard::stopping_speed(double distance) const {
  const double braking = kBrakingShare * max_acceleration_;
  const double half_step = 0.5 * braking * kStepS;
  return std::sqrt(2.0 * braking * distance + half_step * half_step) - half_step;
}

}  // namespace skein::sim
