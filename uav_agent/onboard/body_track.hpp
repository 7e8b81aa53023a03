// Interpolates the pose of the body between the odometry messages of two exchanges.
// Frames: W world, B body.   Units: SI, radians.   Pure; threads: one.
#pragma once

#include <deque>
#include <optional>

#include "core/types.hpp"

namespace skein::agent {

class BodyTrack {
 public:
  struct Pose {
    Isometry3d X_WB = Isometry3d::Identity();
    double error_m = 0.0, error_rad = 0.0;  ///< bounds of the interpolation error; 0 at the tick of a message
  };

  /// @param memory  greatest age of a pose that at() can return.
  /// @param longest_gap  greatest time between two messages over which at() interpolates.
  BodyTrack(Tick memory, Tick longest_gap) : memory_(memory), longest_gap_(longest_gap) {}

  /// Adds an odometry message. If it is not newer than the last one, the track begins anew with it.
  void add(Tick tick, const RigidBodyState& state);

  /// Pose at a tick. Between two messages, the position is a cubic Hermite curve through the positions and velocities
  /// at both; so is the rotation vector relative to the first attitude. With a time h between the messages, the error
  /// is at most h^2 / 16 times the largest acceleration: for h = 0.05 s and the limits below, 3.2 mm and 6.3 mrad.
  /// Errors in flight are far smaller.
  /// @returns nullopt outside the messages' times, and in gaps longer than longest_gap.
  std::optional<Pose> at(Tick tick) const;

  static constexpr double kMostAcceleration = 20.0;         ///< of the body [m/s^2]; vehicle: more than any
  static constexpr double kMostAngularAcceleration = 40.0;  ///< [rad/s^2]; vehicle: more than any

 private:
  struct Sample {
    Tick tick = 0;
    RigidBodyState state;
  };
  Tick memory_, longest_gap_;
  std::deque<Sample> samples_;
};

}  // namespace skein::agent
