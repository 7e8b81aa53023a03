// One multirotor from command to force: trajectory controller and gimbal at 20 Hz; attitude loop, motors and
// aerodynamics every tick. Independent of the physics engine: the caller provides the state and applies the wrench.
// Frames: W world (ENU), B body (FLU).  Units: SI, radians.
#pragma once

#include <array>
#include <optional>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"
#include "sim_server/flight/attitude_control.hpp"
#include "sim_server/flight/command_guard.hpp"
#include "sim_server/flight/gimbal.hpp"
#include "sim_server/flight/position_control.hpp"

namespace skein::sim {

/// Ticks between two steps of the 20 Hz controllers.
inline constexpr Tick kControlTicks = 20;

/// Force that acts at Bo, and torque, expressed in B. The physics engine accounts for the centre of mass.
struct Wrench {
  Vector3d force_B = Vector3d::Zero();
  Vector3d torque_B = Vector3d::Zero();
};

/// Six rotors: their speeds, which follow the demand with a first-order lag, and their forces and torques.
/// Rotors with even numbers turn counter-clockwise, so that their drag turns the body clockwise. All forces act at the
/// hubs, so the drag of rotors above the centre of mass also tilts the vehicle.
/// Model: thrust k_F w^2 along body z; torque k_M times thrust against the rotation; in flight also a drag and a
/// rolling moment, both proportional to rotor speed and to the velocity across the rotor's axis (Furrer et al., "RotorS
/// -- A Modular Gazebo MAV Simulator Framework", 2016).
class Rotors {
 public:
  /// @param step_s  time that a step takes.
  explicit Rotors(const VehicleConfig& vehicle, double step_s = kTickS);

  /// One step towards the demanded speeds; no rotor exceeds its maximum speed.
  void step(const RotorSpeeds& demand);
  /// Total wrench of the rotors. @param v_WA  velocity of the air.
  Wrench wrench(const RigidBodyState& state, const Vector3d& v_WA = Vector3d::Zero()) const;
  /// Force in moving air less the force in still air, in B [N]. @param v_A_B  velocity of the air, in B.
  Vector3d pushed_B(const Vector3d& v_A_B) const;
  /// Thrust of each rotor [N].
  std::array<double, kRotors> thrusts_n() const;
  /// Damages rotors. @param shares  share of its thrust and torque that each rotor still gives at its speed, [0, 1].
  void damage(const std::array<double, kRotors>& shares) { shares_ = shares; }
  const RotorSpeeds& speeds() const { return speeds_; }

 private:
  double force_constant_, moment_constant_, drag_, rolling_moment_, max_speed_;
  double blend_up_, blend_down_;  ///< share of the difference to the demand that a step covers
  std::array<Vector3d, kRotors> p_BR_;
  RotorSpeeds speeds_{};
  std::array<double, kRotors> shares_;
};

/// Not thread-safe.
class Vehicle {
 public:
  /// @param step_s         step of the physics: kTickS, or kTickS / n with n calls of fly() per tick.
  /// @param command_ticks  period at which a pilot can send commands: the exchange period.
  Vehicle(const VehicleConfig& vehicle, const RulesConfig& rules, double step_s = kTickS,
          Tick command_ticks = kControlTicks);

  /// Reason why a command must be ignored; see CommandGuard.
  std::optional<std::string> refuse(const TrajectoryCommand& command, const RigidBodyState& state) const {
    return guard_.refuse(command, state);
  }

  /// Runs the 20 Hz controllers. Call it every kControlTicks. Until the first command the motors stand still. If the
  /// next command is more than 0.1 s late, the last one lapses and the UAV holds its position; the gimbal likewise
  /// holds its angle after a rate command.
  /// @param command, gimbal_command  arrived since the last call; nullopt: none.
  void control(Tick tick, const RigidBodyState& state, const std::optional<TrajectoryCommand>& command,
               const std::optional<GimbalCommand>& gimbal_command);

  /// Runs the attitude loop. Call it every tick.
  void control_attitude(const RigidBodyState& state);
  /// Runs the motors. Call it every step of the physics. @param v_WA  velocity of the air. @returns the wrench during
  /// the coming step.
  Wrench fly(const RigidBodyState& state, const Vector3d& v_WA = Vector3d::Zero());
  /// Runs both. Only if a step is a tick.
  Wrench step(const RigidBodyState& state) {
    control_attitude(state);
    return fly(state);
  }

  /// From now on rotors give only a share of their thrust and torque; the controllers do not know.
  void damage_rotors(const std::array<double, kRotors>& shares) { rotors_.damage(shares); }
  /// Jams or releases the gimbal; see Gimbal::jam().
  void jam_gimbal(bool jammed) { gimbal_.jam(jammed); }
  /// Cuts the motors, for good.
  void stop() { position_control_.stop(); }

  /// Part of the rotors' force that is due to wind, in B [N]; exact, because their drag is linear.
  /// @param v_A_B  velocity of the air, in B.
  Vector3d rotors_pushed_B(const Vector3d& v_A_B) const { return rotors_.pushed_B(v_A_B); }

  const GimbalState& gimbal() const { return gimbal_.state(); }
  ControlMode mode() const { return position_control_.memory().mode; }
  /// Demand of the trajectory controller's last step, with the yaw rate within the vehicle's limit.
  const ControlDemand& demand() const { return demand_; }
  /// Demanded acceleration of that step; z includes gravity [m/s^2].
  const Vector3d& target_acceleration() const { return position_control_.target_acceleration(); }
  const RotorSpeeds& rotor_speeds() const { return rotors_.speeds(); }  ///< for tests of thrust and of lost rotors
  std::array<double, kRotors> rotor_thrusts_n() const { return rotors_.thrusts_n(); }

 private:
  CommandGuard guard_;
  PositionController position_control_;
  AttitudeController attitude_control_;
  Rotors rotors_;
  Gimbal gimbal_;
  std::optional<TrajectoryCommand> command_;  ///< the last one that arrived
  Tick command_tick_ = 0;
  Tick grace_;  ///< additional time until the next command is due if commands come at less than 20 Hz
  ControlDemand demand_;
  RotorSpeeds rotor_demand_{};
};

}  // namespace skein::sim
