#include "sim_server/flight/gimbal.hpp"

#include <algorithm>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

/// The reference's truncated value of a degree [rad]. The exact value would move the angle limits by a nanoradian, and
/// rates near them by 20 times as much, which is more than the tolerance of the reference vectors.
constexpr double kDegree = 0.01745329251;
/// Steps for which a rate command is obeyed without a new one, if a command can arrive in every step.
constexpr int kRateCommandSteps = 2;

struct Axis {
  double angle = 0.0, rate = 0.0;
};

Axis move_to(double angle, double target, double limit, double rate_limit) {
  const double error = std::clamp(wrap_angle(target), -limit, limit) - angle;
  const double rate = std::clamp(error / Gimbal::kStepS, -rate_limit, rate_limit);
  return {angle + rate * Gimbal::kStepS, rate};
}

Axis move_at(double angle, double commanded_rate, double limit, double rate_limit, bool phantom_rate) {
  const double rate = std::clamp(commanded_rate, -rate_limit, rate_limit);
  const double next = std::clamp(angle + rate * Gimbal::kStepS, -limit, limit);
  return {next, phantom_rate ? rate : (next - angle) / Gimbal::kStepS};
}

}  // namespace

GimbalMode gimbal_mode(double number) {
  if (number > 0.0) return GimbalMode::angle;
  return number < -1e-7 ? GimbalMode::rate : GimbalMode::freeze;
}

Gimbal::Gimbal(const GimbalConfig& config, bool phantom_rate, int command_steps)
    : config_(config), phantom_rate_(phantom_rate), rate_command_steps_(kRateCommandSteps + command_steps - 1) {}

void Gimbal::step(const std::optional<GimbalCommand>& command) {
  ++steps_since_command_;
  if (command) {
    command_ = *command;
    steps_since_command_ = 0;
  }
  if (command_.mode == GimbalMode::rate && steps_since_command_ > rate_command_steps_) {
    command_ = {GimbalMode::angle, state_.pitch, state_.yaw};
  }
  if (jammed_) {
    state_ = {state_.pitch, state_.yaw, 0.0, 0.0};
    return;
  }

  const double pitch_limit = config_.pitch_limit_deg * kDegree;
  const double yaw_limit = config_.yaw_limit_deg * kDegree;
  const double rate_limit = config_.rate_limit_deg_s * kDegree;
  Axis pitch{state_.pitch, phantom_rate_ ? state_.pitch_rate : 0.0};
  Axis yaw{state_.yaw, phantom_rate_ ? state_.yaw_rate : 0.0};
  if (command_.mode == GimbalMode::angle) {
    pitch = move_to(pitch.angle, command_.pitch, pitch_limit, rate_limit);
    yaw = move_to(yaw.angle, command_.yaw, yaw_limit, rate_limit);
  } else if (command_.mode == GimbalMode::rate) {
    pitch = move_at(pitch.angle, command_.pitch, pitch_limit, rate_limit, phantom_rate_);
    yaw = move_at(yaw.angle, command_.yaw, yaw_limit, rate_limit, phantom_rate_);
  }
  state_ = {pitch.angle, yaw.angle, pitch.rate, yaw.rate};
}

}  // namespace skein::sim
