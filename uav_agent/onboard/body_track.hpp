// Where the body was between two exchanges, from the odometry of the exchanges.
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
    double error_m = 0.0, error_rad = 0.0;  ///< bounds of what interpolation adds; 0 at the tick of an odometry
  };

  /// @param memory  how old a pose may be asked for; @param longest_gap  between two odometries, to interpolate.
  BodyTrack(Tick memory, Tick longest_gap) : memory_(memory), longest_gap_(longest_gap) {}

  /// One that is not younger than the last begins a new track.
  void add(Tick tick, const RigidBodyState& state);

  /// Between two odometries: cubic in time, with the velocities at both ends; the same for the rotation vector from the
  /// first attitude. Such a curve is off by h^2 / 32 times as much as its second derivative is off: within h = 0.05 s,
  /// and with accelerations up to kMost..., by 3.2 mm and 6.3 mrad at most. Flights stay far below.
  /// @returns nullopt outside of what it has, and in a gap.
  std::optional<Pose> at(Tick tick) const;

  static constexpr double kMostAcceleration = 20.0;         ///< of the body [m/s^2]
  static constexpr double kMostAngularAcceleration = 40.0;  ///< [rad/s^2]

 private:
  struct Sample {
    Tick tick = 0;
    RigidBodyState state;
  };
  Tick memory_, longest_gap_;
  std::deque<Sample> samples_;
};

}  // namespace skein::agent
