#include "sim_server/flight/position_control.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

constexpr double kGravity = 9.781;
constexpr double kHoverFactor = 0.19;    ///< thrust at hover / thrust scale
constexpr double kNone = 0.01;           ///< a shorter vector means "not given"
constexpr double kAtTarget = 0.05;       ///< a target nearer than this does not make the UAV move [m]
constexpr double kMaxHorizontal = 10.0;  ///< [m/s^2]
constexpr double kMinVertical = 0.3 * kGravity, kMaxVertical = 2.0 * kGravity;
constexpr double kYawGain = 2.0, kYawIntegralGain = 0.02;
constexpr double kYawSumLimit = 1.57;
constexpr double kMaxYawRate = 90.0 * kRadPerDeg;

bool asked_for(const Vector3d& v) { return v.norm() >= kNone; }

Vector3d clamped(const Vector3d& v, double limit) { return v.cwiseMax(-limit).cwiseMin(limit); }

struct Tilt {
  double roll = 0.0, pitch = 0.0;
};

/// Roll and pitch that point body z along an acceleration at the present yaw.
Tilt tilt_towards(const Vector3d& acceleration, double yaw) {
  const Vector3d bz = acceleration.normalized();
  const Vector3d yc(-std::sin(yaw), std::cos(yaw), 0.0);
  const Vector3d bx = yc.cross(bz).normalized();
  Matrix3d R_WB;
  R_WB << bx, bz.cross(bx), bz;
  const RollPitchYaw rpy = roll_pitch_yaw(R_WB);
  return {rpy.roll, rpy.pitch};
}

}  // namespace

ControlDemand PositionController::step(const RigidBodyState& state, const std::optional<TrajectoryCommand>& new_command,
                                       Tick command_age) {
  if (memory_.mode == ControlMode::stopped) return {};
  if (new_command) memory_.command = *new_command;
  if (memory_.mode == ControlMode::idle) {
    if (!new_command) return {};
    memory_.mode = ControlMode::hold;  // the same rules apply as to a command that ends a hold
  }
  update_mode(state, command_age);

  const TrajectoryCommand& command = memory_.command;
  memory_.position_error_sum = clamped(memory_.position_error_sum + command.p_WB - state.p_WB, kPositionSumLimit);
  target_acceleration_ = demanded_acceleration(state);

  const Matrix3d R_WB = state.q_WB.toRotationMatrix();
  const double yaw = roll_pitch_yaw(R_WB).yaw;
  const Tilt tilt = tilt_towards(target_acceleration_, yaw);
  const double max_tilt = config_.max_tilt_deg * kRadPerDeg;

  // The sum uses the error without wrapping, the proportional term with it.
  const double yaw_error = wrap_angle(command.yaw) - yaw;
  memory_.yaw_error_sum = std::clamp(memory_.yaw_error_sum + yaw_error, -kYawSumLimit, kYawSumLimit);
  const double yaw_rate = kYawGain * wrap_angle(yaw_error) + kYawIntegralGain * memory_.yaw_error_sum;

  ControlDemand demand;
  demand.roll = std::clamp(tilt.roll, -max_tilt, max_tilt);
  demand.pitch = std::clamp(tilt.pitch, -max_tilt, max_tilt);
  demand.yaw_rate = std::clamp(yaw_rate, -kMaxYawRate, kMaxYawRate);
  demand.thrust_N = target_acceleration_.dot(R_WB.col(2)) / kGravity * kHoverFactor * config_.thrust_scale;
  return demand;
}

void PositionController::update_mode(const RigidBodyState& state, Tick command_age) {
  TrajectoryCommand& command = memory_.command;
  if (command_age > kMaxAge) {
    if (memory_.mode == ControlMode::hold) return;
    memory_.mode = ControlMode::hold;
    command = {state.p_WB, Vector3d::Zero(), Vector3d::Zero(), roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw};
    return;
  }
  if (command_age == kMaxAge) return;
  const bool all_zero = !asked_for(command.p_WB) && !asked_for(command.v_WB) && !asked_for(command.a_WB);
  if (all_zero && memory_.mode != ControlMode::yaw_only) {
    memory_.mode = ControlMode::yaw_only;
    command.p_WB = state.p_WB;
  } else if ((command.p_WB - state.p_WB).norm() > kAtTarget || command.v_WB.norm() > kNone ||
             command.a_WB.norm() > kNone) {
    memory_.mode = ControlMode::moving;
  }
}

Vector3d PositionController::demanded_acceleration(const RigidBodyState& state) const {
  const TrajectoryCommand& command = memory_.command;
  const Vector3d omega(config_.omega_xy, config_.omega_xy, config_.omega_z);
  const Vector3d zeta(config_.zeta_xy, config_.zeta_xy, config_.zeta_z);
  const Vector3d ki(config_.ki_xy, config_.ki_xy, config_.ki_z);
  const bool use_position = asked_for(command.p_WB);
  const bool use_velocity = use_position || asked_for(command.v_WB);

  Vector3d a = command.a_WB + ki.cwiseProduct(memory_.position_error_sum) + kGravity * Vector3d::UnitZ();
  if (use_position) a += omega.cwiseProduct(omega).cwiseProduct(command.p_WB - state.p_WB);
  if (use_velocity) a += 2.0 * zeta.cwiseProduct(omega).cwiseProduct(command.v_WB - state.v_WB);
  return {std::clamp(a.x(), -kMaxHorizontal, kMaxHorizontal), std::clamp(a.y(), -kMaxHorizontal, kMaxHorizontal),
          std::clamp(a.z(), kMinVertical, kMaxVertical)};
}

}  // namespace skein::sim
