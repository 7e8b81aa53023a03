#include "sim_server/flight/vehicle.hpp"

#include <algorithm>
#include <cmath>

namespace skein::sim {

Rotors::Rotors(const VehicleConfig& vehicle, double step_s)
    : force_constant_(vehicle.rotor_force_constant),
      moment_constant_(vehicle.rotor_moment_constant),
      drag_(vehicle.rotor_drag),
      rolling_moment_(vehicle.rolling_moment),
      max_speed_(vehicle.rotor_max_speed),
      blend_up_(1.0 - std::exp(-step_s / vehicle.motor_time_constant_up_s)),
      blend_down_(1.0 - std::exp(-step_s / vehicle.motor_time_constant_down_s)),
      p_BR_(rotor_hubs(vehicle)) {
  shares_.fill(1.0);
}

void Rotors::step(const RotorSpeeds& demand) {
  for (std::size_t i = 0; i < kRotors; ++i) {
    const double gap = std::min(demand[i], max_speed_) - speeds_[i];
    speeds_[i] += (gap > 0.0 ? blend_up_ : blend_down_) * gap;
  }
}

std::array<double, kRotors> Rotors::thrusts_n() const {
  std::array<double, kRotors> thrusts{};
  for (std::size_t i = 0; i < kRotors; ++i) thrusts[i] = shares_[i] * force_constant_ * speeds_[i] * speeds_[i];
  return thrusts;
}

Wrench Rotors::wrench(const RigidBodyState& state, const Vector3d& v_WA) const {
  const Vector3d v_AB_B = state.q_WB.conjugate() * (state.v_WB - v_WA);
  Wrench sum;
  for (std::size_t i = 0; i < kRotors; ++i) {
    const double speed = speeds_[i];
    const double thrust = force_constant_ * speed * speed;
    Vector3d v_across = v_AB_B + state.w_WB_B.cross(p_BR_[i]);
    v_across.z() = 0.0;
    const Vector3d force = shares_[i] * (thrust * Vector3d::UnitZ() - drag_ * speed * v_across);
    const double reaction = (i % 2 == 0 ? -1.0 : 1.0) * shares_[i] * moment_constant_ * thrust;
    sum.force_B += force;
    sum.torque_B +=
        p_BR_[i].cross(force) + reaction * Vector3d::UnitZ() - shares_[i] * rolling_moment_ * speed * v_across;
  }
  return sum;
}

Vector3d Rotors::pushed_B(const Vector3d& v_A_B) const {
  double drag_n_s_m = 0.0;
  for (std::size_t i = 0; i < kRotors; ++i) drag_n_s_m += shares_[i] * drag_ * speeds_[i];
  return drag_n_s_m * Vector3d(v_A_B.x(), v_A_B.y(), 0.0);
}

namespace {

/// Control steps from one command to the next if commands come every `command_ticks`.
int control_steps(Tick command_ticks) {
  return static_cast<int>(std::max<Tick>(1, (command_ticks + kControlTicks - 1) / kControlTicks));
}

}  // namespace

Vehicle::Vehicle(const VehicleConfig& vehicle, const RulesConfig& rules, double step_s, Tick command_ticks)
    : guard_(vehicle, rules),
      position_control_(vehicle.position_control),
      attitude_control_(vehicle),
      rotors_(vehicle, step_s),
      gimbal_(vehicle.gimbal, rules.phantom_gimbal_rate, control_steps(command_ticks)),
      grace_((control_steps(command_ticks) - 1) * kControlTicks) {}

void Vehicle::control(Tick tick, const RigidBodyState& state, const std::optional<TrajectoryCommand>& command,
                      const std::optional<GimbalCommand>& gimbal_command) {
  gimbal_.step(gimbal_command);
  if (command) {
    command_ = command;
    command_tick_ = tick;
  }
  const Tick age = std::max<Tick>(0, tick - command_tick_ - grace_);
  // The controller keeps the last command by itself; it needs new ones only while the guard moves the position.
  std::optional<TrajectoryCommand> new_command;
  if (command_ && age <= PositionController::kMaxAge) {
    const bool was_leading = guard_.leading();
    const TrajectoryCommand led = guard_.lead(*command_, state);
    if (command || was_leading || guard_.leading()) new_command = led;
  } else {
    guard_.reset();
  }
  demand_ = position_control_.step(state, new_command, age);
  demand_.yaw_rate = guard_.limit_yaw_rate(demand_.yaw_rate);
}

void Vehicle::control_attitude(const RigidBodyState& state) {
  const bool powered = mode() != ControlMode::idle && mode() != ControlMode::stopped;
  rotor_demand_ = powered ? attitude_control_.step(state.q_WB, state.w_WB_B, demand_) : RotorSpeeds{};
}

Wrench Vehicle::fly(const RigidBodyState& state, const Vector3d& v_WA) {
  rotors_.step(rotor_demand_);
  return rotors_.wrench(state, v_WA);
}

}  // namespace skein::sim
