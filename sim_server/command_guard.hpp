// Keeps a UAV within its vehicle's limits, outside the control law: refuses set-points beyond them, and leads
// the UAV to a far position so that it goes no faster than it may. Frame: W.  Units: SI.
// The contest says that a command beyond the kinematic limits is ignored, and its code has no such check;
// `rules.enforce_command_limits` turns all but the test for finite numbers off.
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

  /// Why a command must be ignored, as a sentence for the user; nullopt if it need not be. Refused are numbers that
  /// are not finite, a velocity or acceleration beyond the vehicle's, and a bare acceleration that would push a UAV
  /// at its speed limit beyond it. A position is never too far. Pure.
  std::optional<std::string> refuse(const TrajectoryCommand& command, const RigidBodyState& state) const;

  /// The command with a position that the control law can follow within the limits. Call it once per control step
  /// (1/20 s), with the command in effect.
  ///
  /// A position passes as it is when the law goes there with no more than the permitted horizontal acceleration and
  /// speed. Otherwise a point runs ahead of the UAV to that position, within the vehicle's speed and acceleration, and
  /// stands in for it. The law follows a moving point like a critically damped filter: its output is never steeper
  /// than its input.
  TrajectoryCommand lead(const TrajectoryCommand& command, const RigidBodyState& state);

  /// Whether a point stands in for the commanded position at present.
  bool leading() const { return carrot_.has_value(); }
  /// Forget the point on its way, as there is no command in effect.
  void reset() { carrot_.reset(); }

 private:
  struct Carrot {
    Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero();
  };
  bool within_limits(const TrajectoryCommand& command, const RigidBodyState& state) const;
  Carrot launch(const TrajectoryCommand& command, const RigidBodyState& state) const;
  void move_carrot(const TrajectoryCommand& command);
  double stopping_speed(double distance) const;

  bool enforce_;
  double max_speed_, max_acceleration_;
  double omega_;            ///< of the horizontal law [1/s]
  double speed_per_error_;  ///< at which a constant distance to a moving position is kept [1/s]
  std::optional<Carrot> carrot_;
};

}  // namespace skein::sim
