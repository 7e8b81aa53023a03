#include "sim_server/command_guard.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace skein::sim {
namespace {

constexpr double kStepS = 0.05;     ///< of the control law
constexpr double kRounding = 1e-6;  ///< a command may exceed a limit by this share
constexpr double kGiven = 0.01;     ///< shorter vectors mean "none" to the control law
constexpr double kTiny = 1e-9;      ///< [m]

std::string beyond(const char* what, double value, double limit, const char* unit) {
  std::ostringstream text;
  text << std::setprecision(4) << what << " of " << value << " " << unit << " is beyond the vehicle's limit of "
       << limit << " " << unit;
  return text.str();
}

/// The same direction, no longer than `length`.
Vector3d shortened(const Vector3d& v, double length) {
  const double norm = v.norm();
  return norm > length ? Vector3d(v * (length / norm)) : v;
}

}  // namespace

CommandGuard::CommandGuard(const VehicleConfig& vehicle, const RulesConfig& rules)
    : enforce_(rules.enforce_command_limits),
      max_speed_(vehicle.max_speed_mps),
      max_acceleration_(vehicle.max_acceleration_mps2) {
  const PositionControlConfig& law = vehicle.position_control;
  omega_ = law.omega_xy;
  speed_per_error_ = law.omega_xy / (2.0 * law.zeta_xy);
}

std::optional<std::string> CommandGuard::refuse(const TrajectoryCommand& command, const RigidBodyState& state) const {
  if (!command.p_WB.allFinite() || !command.v_WB.allFinite() || !command.a_WB.allFinite() ||
      !std::isfinite(command.yaw)) {
    return "a set-point must consist of finite numbers";
  }
  if (!enforce_) return std::nullopt;
  const double speed = command.v_WB.norm(), acceleration = command.a_WB.norm();
  if (speed > max_speed_ * (1.0 + kRounding)) return beyond("a velocity", speed, max_speed_, "m/s");
  if (acceleration > max_acceleration_ * (1.0 + kRounding)) {
    return beyond("an acceleration", acceleration, max_acceleration_, "m/s^2");
  }
  const bool bare_acceleration = command.p_WB.norm() < kGiven && speed < kGiven && acceleration >= kGiven;
  if (bare_acceleration && state.v_WB.dot(command.a_WB) > 0.0) {
    const double next_speed = (state.v_WB + command.a_WB * kStepS).norm();
    if (next_speed > max_speed_) {
      return beyond("an acceleration that leads to a speed", next_speed, max_speed_, "m/s");
    }
  }
  return std::nullopt;
}

TrajectoryCommand CommandGuard::lead(const TrajectoryCommand& command, const RigidBodyState& state) {
  if (!enforce_ || command.p_WB.norm() < kGiven) {
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
  TrajectoryCommand led = command;
  led.p_WB = carrot_->p_W;
  if (within && carrot_->p_W == command.p_WB) carrot_.reset();
  return led;
}

bool CommandGuard::within_limits(const TrajectoryCommand& command, const RigidBodyState& state) const {
  const Vector3d error = command.p_WB - state.p_WB;
  return omega_ * omega_ * error.norm() <= max_acceleration_ &&
         (command.v_WB + speed_per_error_ * error).norm() <= max_speed_;
}

CommandGuard::Carrot CommandGuard::launch(const TrajectoryCommand& command, const RigidBodyState& state) const {
  const Vector3d to_target = command.p_WB - state.p_WB;
  const double distance = to_target.norm();
  if (distance == 0.0) return {command.p_WB, command.v_WB};
  const Vector3d direction = to_target / distance;
  // As far ahead as keeps up the present speed, so that a UAV under way neither jerks nor brakes.
  const double speed = std::clamp((state.v_WB - command.v_WB).dot(direction), 0.0, max_speed_);
  const double ahead = std::min(speed / speed_per_error_, distance);
  const double carrot_speed = std::min(speed, stopping_speed(distance - ahead));
  return {state.p_WB + ahead * direction, shortened(command.v_WB + carrot_speed * direction, max_speed_)};
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

/// The speed from which it can still stop within a distance, one step from now on.
double CommandGuard::stopping_speed(double distance) const {
  const double half_step = 0.5 * max_acceleration_ * kStepS;
  return std::sqrt(2.0 * max_acceleration_ * distance + half_step * half_step) - half_step;
}

}  // namespace skein::sim
