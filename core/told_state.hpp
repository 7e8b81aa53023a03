// What a UAV's own software is told of its state beside its odometry: how sure that is, the battery, the wind.
// Frame: W world (ENU).  Units: SI, radians.
#pragma once

#include "core/types.hpp"

namespace skein {

/// Standard deviations of what the odometry says; all 0: it is exact.
struct PoseUncertainty {
  Vector3d position_m = Vector3d::Zero();  ///< of each axis of W
  double yaw = 0.0;                        ///< [rad]
  double velocity_mps = 0.0;               ///< of each axis

  bool exact() const { return position_m.isZero(0.0) && yaw == 0.0 && velocity_mps == 0.0; }
};

struct BatteryStatus {
  double charge = 1.0;       ///< share of the capacity that is left, [0, 1]
  double capacity_ah = 0.0;  ///< when full
  double voltage_v = 0.0;    ///< at its terminals
  double current_a = 0.0;    ///< that flows out of it
};

}  // namespace skein
