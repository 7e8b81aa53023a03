// Keeps a UAV within its vehicle's limits, outside the control law: refuses setpoints beyond the limits, and limits
// the speed of flights to far positions. Frame: W.  Units: SI.
// The contest's rules say that commands beyond the kinematic limits are ignored, but its code neither checks commands
// nor limits speed. The rules' switches `reject_commands_beyond_limits` and `guard_position_commands` turn the two
// functions off. With both off, the control law gets each command unchanged.
#pragma once

#include <optional>
#include <string>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// One UAV's guard. Not thread-safe.
class CommandGuard {
 public:
  CommandGuard(const VehicleConfig& vehicle, const RulesConfig& rules);

  /// Reason why a command must be ignored, as a sentence for the user; nullopt: it is accepted. The guard refuses a
  /// velocity, acceleration or yaw rate beyond the vehicle's limit, and an acceleration without position and velocity
  /// that would lead beyond the speed limit; under all rules, numbers that are not finite, or too large to compute with
  /// (1e154). Up to there it refuses no position and no yaw for its distance. Pure.
  std::optional<std::string> refuse(const TrajectoryCommand& command, const RigidBodyState& state) const;

  /// The command with a position that the control law can follow within the limits. Call it once per control step
  /// (1/20 s), with the command in effect.
  ///
  /// A position remains unchanged if the law reaches it within the permitted acceleration and speed. Otherwise a point
  /// (the carrot) replaces it, which moves ahead of the UAV to that position within the vehicle's speed and
  /// acceleration. The law follows a moving point like a critically damped filter, so the UAV gets no faster than the
  /// point. The distance of the point from the UAV is limited so that the law does not exceed the permitted
  /// acceleration. The guard does not limit the acceleration that results from a velocity given with the position.
  TrajectoryCommand lead(const TrajectoryCommand& command, const RigidBodyState& state);

  /// Limits the yaw rate that the law demands to the vehicle's limit [rad/s].
  double limit_yaw_rate(double demanded) const;

  /// Whether the carrot replaces the commanded position at present.
  bool leading() const { return carrot_.has_value(); }
  /// Forgets the carrot, because no command is in effect.
  void reset() { carrot_.reset(); }

 private:
  struct Carrot {
    Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero();
  };
  Vector3d damping(const TrajectoryCommand& command, const RigidBodyState& state) const;
  Vector3d demand(const Vector3d& p_W, const TrajectoryCommand& command, const RigidBodyState& state) const;
  bool within_limits(const TrajectoryCommand& command, const RigidBodyState& state) const;
  Carrot launch(const TrajectoryCommand& command, const RigidBodyState& state) const;
  void move_carrot(const TrajectoryCommand& command);
  void hold_carrot_back(const TrajectoryCommand& command, const RigidBodyState& state);
  double stopping_speed(double distance) const;

  bool reject_, guard_;
  double max_speed_, max_acceleration_, max_yaw_rate_;
  Vector3d stiffness_;  ///< of the law: acceleration per position error [1/s^2]
  Vector3d damping_;    ///< of the law: acceleration per velocity error [1/s]
  std::optional<Carrot> carrot_;
};

}  // namespace skein::sim
