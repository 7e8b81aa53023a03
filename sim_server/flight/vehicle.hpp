// One multirotor from command to force: trajectory controller and gimbal at 20 Hz, attitude loop, motors and
// aerodynamics every tick. It knows no physics engine: the caller gives its state and applies its wrench.
// Frames: W world (ENU), B body (FLU).  Units: SI, radians.
#pragma once

#include <array>
#include <optional>

#include "core/scenario.hpp"
#include "core/types.hpp"
#include "sim_server/flight/attitude_control.hpp"
#include "sim_server/flight/command_guard.hpp"
#include "sim_server/flight/gimbal.hpp"
#include "sim_server/flight/position_control.hpp"

namespace skein::sim {

/// Ticks between two steps of the 20 Hz controllers.
inline constexpr Tick kControlTicks = 20;

/// Force that acts at Bo, and torque, expressed in B. Where the centre of mass is, is the business of the physics.
struct Wrench {
  Vector3d force_B = Vector3d::Zero();
  Vector3d torque_B = Vector3d::Zero();
};

/// Six rotors: speeds that follow their demand with a first-order lag, and the forces that follow from them.
/// Even ones turn counter-clockwise, so that their drag turns the body clockwise. All forces act at the hubs: the drag
/// of rotors that stand above the centre of mass tilts the vehicle, too.
/// Model: thrust k_F w^2 along body z; torque k_M times thrust against the turn; in flight also a drag and a rolling
/// moment, both proportional to rotor speed and to the velocity across the rotor's axis (Furrer et al., "RotorS -- A
/// Modular Gazebo MAV Simulator Framework", 2016).
class Rotors {
 public:
  /// @param step_s  time that a step takes.
  explicit Rotors(const VehicleConfig& vehicle, double step_s = kTickS);

  /// One step towards the demanded speeds; no rotor exceeds its greatest speed.
  void step(const RotorSpeeds& demand);
  /// @param v_WA  velocity of the air.
  Wrench wrench(const RigidBodyState& state, const Vector3d& v_WA = Vector3d::Zero()) const;
  /// By which the force in moving air exceeds that in still air, in B. @param v_A_B  velocity of the air, in B
  Vector3d pushed_B(const Vector3d& v_A_B) const;
  /// Thrust of each [N].
  std::array<double, kRotors> thrusts_n() const;
  /// Damage. @param shares  of thrust and torque that each rotor gives at its speed, [0, 1].
  void damage(const std::array<double, kRotors>& shares) { shares_ = shares; }
  const RotorSpeeds& speeds() const { return speeds_; }

 private:
  double force_constant_, moment_constant_, drag_, rolling_moment_, max_speed_;
  double blend_up_, blend_down_;  ///< share of the way to the demand covered in a step
  std::array<Vector3d, kRotors> p_BR_;
  RotorSpeeds speeds_{};
  std::array<double, kRotors> shares_;
};

/// Not thread-safe.
class Vehicle {
 public:
  /// @param step_s         step of the physics: kTickS, or a whole part of it, with several calls of fly() a tick.
  /// @param command_ticks  how often a pilot can send a command: the exchange period.
  Vehicle(const VehicleConfig& vehicle, const RulesConfig& rules, double step_s = kTickS,
          Tick command_ticks = kControlTicks);

  /// Why a command must be ignored; see CommandGuard.
  std::optional<std::string> refuse(const TrajectoryCommand& command, const RigidBodyState& state) const {
    return guard_.refuse(command, state);
  }

  /// The 20 Hz controllers: every kControlTicks. Until the first command the motors stand still. A command lapses 0.1 s
  /// after the next one was due, and the UAV holds its position; a gimbal's rate command likewise.
  /// @param command, gimbal_command  arrived since the last call, if any did.
  void control(Tick tick, const RigidBodyState& state, const std::optional<TrajectoryCommand>& command,
               const std::optional<GimbalCommand>& gimbal_command);

  /// Attitude loop: every tick.
  void control_attitude(const RigidBodyState& state);
  /// Motors: every step of the physics. @param v_WA  velocity of the air. @returns the wrench during the coming step.
  Wrench fly(const RigidBodyState& state, const Vector3d& v_WA = Vector3d::Zero());
  /// Both, where a step is a tick.
  Wrench step(const RigidBodyState& state) {
    control_attitude(state);
    return fly(state);
  }

  /// Rotors that give only a share of their thrust and torque, from now on; the controllers do not know.
  void damage_rotors(const std::array<double, kRotors>& shares) { rotors_.damage(shares); }
  /// The gimbal stays where it is, from now on or no longer.
  void jam_gimbal(bool jammed) { gimbal_.jam(jammed); }
  /// Cut the motors, for good.
  void stop() { position_control_.stop(); }

  /// The part of the rotors' force that is due to wind, in B: their drag is linear. @param v_A_B  of the air, in B
  Vector3d rotors_pushed_B(const Vector3d& v_A_B) const { return rotors_.pushed_B(v_A_B); }

  const GimbalState& gimbal() const { return gimbal_.state(); }
  ControlMode mode() const { return position_control_.memory().mode; }
  /// What the trajectory controller asked for in its last step, the vehicle's yaw rate considered.
  const ControlDemand& demand() const { return demand_; }
  /// Acceleration that it asked for; z includes gravity [m/s^2].
  const Vector3d& target_acceleration() const { return position_control_.target_acceleration(); }
  const RotorSpeeds& rotor_speeds() const { return rotors_.speeds(); }
  std::array<double, kRotors> rotor_thrusts_n() const { return rotors_.thrusts_n(); }

 private:
  CommandGuard guard_;
  PositionController position_control_;
  AttitudeController attitude_control_;
  Rotors rotors_;
  Gimbal gimbal_;
  std::optional<TrajectoryCommand> command_;  ///< the last that arrived
  Tick command_tick_ = 0;
  Tick grace_;  ///< so much later than at 20 Hz is the next command due
  ControlDemand demand_;
  RotorSpeeds rotor_demand_{};
};

}  // namespace skein::sim
