// Keeps a UAV within its vehicle's limits, outside the control law: refuses set-points beyond them, and leads
// the UAV to a far position so that it goes no faster than it may. Frame: W.  Units: SI.
// The contest says that a command beyond the kinematic limits is ignored, and its code has neither a check nor a limit
// of speed. Two switches of the rules turn the two halves off: `reject_commands_beyond_limits`,
// `guard_position_commands`. With both off the control law gets each command as it came.
#pragma once

#include <optional>
#include <string>

#include "core/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// One UAV's guard. Not thread-safe.
class CommandGuard {
 public:
  CommandGuard(const VehicleConfig& vehicle, const RulesConfig& rules);

  /// Why a command must be ignored, as a sentence for the user; nullopt if it need not be. Refused are a velocity,
  /// acceleration or yaw rate beyond the vehicle's, and a bare acceleration that would push a UAV at its speed limit
  /// beyond it; numbers that are not finite, whatever the rules. A position or a yaw is never too far. Pure.
  std::optional<std::string> refuse(const TrajectoryCommand& command, const RigidBodyState& state) const;

  /// The command with a position that the control law can follow within the limits. Call it once per control step
  /// (1/20 s), with the command in effect.
  ///
  /// A position passes as it is when the law goes there with no more than the permitted acceleration and speed.
  /// Otherwise a point runs ahead of the UAV to that position, within the vehicle's speed and acceleration, and
  /// stands in for it. The law follows a moving point like a critically damped filter: its output is never steeper
  /// than its input. The point comes no farther from the UAV than the permitted acceleration pulls. What a velocity
  /// that is given beside the position demands is the pilot's business, and not limited here.
  TrajectoryCommand lead(const TrajectoryCommand& command, const RigidBodyState& state);

  /// The yaw rate that the law demands, within the vehicle's limit [rad/s].
  double limit_yaw_rate(double demanded) const;

  /// Whether a point stands in for the commanded position at present.
  bool leading() const { return carrot_.has_value(); }
  /// Forget the point on its way, as there is no command in effect.
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
  Vector3d stiffness_;  ///< of the law: acceleration per error [1/s^2]
  Vector3d damping_;    ///< acceleration per speed [1/s]
  std::optional<Carrot> carrot_;
};

}  // namespace skein::sim
