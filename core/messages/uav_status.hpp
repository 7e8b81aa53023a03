// Data that the on-board software receives in addition to odometry: uncertainty of the pose, battery status, quality of
// links.
// Frame: W world (ENU).  Units: SI, radians.
#pragma once

#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "core/types.hpp"

namespace skein {

/// Standard deviations of the odometry; all 0: the odometry is exact.
struct PoseUncertainty {
  Vector3d position_m = Vector3d::Zero();  ///< along each axis of W
  double yaw = 0.0;                        ///< [rad]
  double velocity_mps = 0.0;               ///< along each axis

  bool exact() const { return position_m.isZero(0.0) && yaw == 0.0 && velocity_mps == 0.0; }
};

struct BatteryStatus {
  static constexpr double kFullCharge = 0.95;  ///< above this charge a battery counts as full, and is not swapped

  double charge = 1.0;       ///< remaining share of the capacity, [0, 1]
  double capacity_ah = 0.0;  ///< of a full battery
  double voltage_v = 0.0;    ///< at the terminals
  double current_a = 0.0;    ///< positive: discharging
};

/// Quality of an open radio link, in scenarios with path loss.
struct LinkQuality {
  double received_dbm = 0.0;  ///< power that arrives; the same in both directions
  double rate_bit_s = 0.0;    ///< for the fleet's messages from this UAV to the other end

  bool operator==(const LinkQuality&) const = default;
};
using LinkQualities = std::vector<std::pair<Node, LinkQuality>>;  ///< by the node at the other end

}  // namespace skein
