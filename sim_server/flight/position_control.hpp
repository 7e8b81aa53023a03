// Trajectory controller of a multirotor, 20 Hz: computes tilt, yaw rate and thrust from a setpoint.
// Frames: W world (ENU), B body (FLU).  Units: SI, radians; age in physics ticks.
// Source: golden vectors `position_control`. The reference has quirks (an integral without a time step; a target near
// the world's origin means "none"), which this controller reproduces; docs/rules.md lists them.
#pragma once

#include <array>
#include <optional>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// Demand to the attitude controller.
struct ControlDemand {
  double roll = 0.0, pitch = 0.0;  ///< [rad]
  double yaw_rate = 0.0;           ///< [rad/s]
  double thrust_N = 0.0;           ///< may be negative; the rotors then stop
};

enum class ControlMode {
  idle,      ///< no command yet: no thrust
  hold,      ///< the command has lapsed: stay at the position of that time
  yaw_only,  ///< the command is all zero but for the yaw: stay and turn
  moving,
  stopped,  ///< no thrust, for good
};
constexpr std::array<EnumName<ControlMode>, 5> enum_names(ControlMode) {
  return {{{"idle", ControlMode::idle},
           {"hold", ControlMode::hold},
           {"yaw_only", ControlMode::yaw_only},
           {"moving", ControlMode::moving},
           {"stopped", ControlMode::stopped}}};
}

/// One UAV's controller. Not thread-safe.
class PositionController {
 public:
  /// A command older than this lapses, and the UAV holds its position. At exactly this age the mode does not change.
  static constexpr Tick kMaxAge = 40;
  static constexpr double kPositionSumLimit = 10.0;  ///< limit of the sum of position errors, per axis [m]

  /// The controller's state from step to step.
  struct Memory {
    ControlMode mode = ControlMode::idle;
    TrajectoryCommand command;                       ///< in effect, after the rules on modes
    Vector3d position_error_sum = Vector3d::Zero();  ///< [m], within +-kPositionSumLimit
    double yaw_error_sum = 0.0;                      ///< [rad], within +-1.57
  };

  explicit PositionController(const PositionControlConfig& config) : config_(config) {}

  /// One step of 1/20 s.
  /// @param new_command  arrived since the last step; it replaces the one in effect. nullopt: none arrived.
  /// @param command_age  time since the last command arrived, less the grace for pilots that send at less than 20 Hz;
  ///                     ignored before the first command.
  ControlDemand step(const RigidBodyState& state, const std::optional<TrajectoryCommand>& new_command,
                     Tick command_age);

  /// Cuts the thrust for good: the UAV falls.
  void stop() { memory_.mode = ControlMode::stopped; }

  const Memory& memory() const { return memory_; }
  void set_memory(const Memory& memory) { memory_ = memory; }
  /// Demanded acceleration of the last step, after limits; z includes gravity [m/s^2].
  const Vector3d& target_acceleration() const { return target_acceleration_; }

 private:
  void update_mode(const RigidBodyState& state, Tick command_age);
  Vector3d demanded_acceleration(const RigidBodyState& state) const;

  PositionControlConfig config_;
  Memory memory_;
  Vector3d target_acceleration_ = Vector3d::Zero();
};

}  // namespace skein::sim
