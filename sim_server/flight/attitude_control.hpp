// Attitude controller of a hexarotor: tilt, yaw rate and thrust to six rotor speeds. Runs every physics tick.
// Frames: B body (FLU).  Units: SI, radians.  Source: golden vectors `attitude_control`.
#pragma once

#include <array>

#include "core/scenario.hpp"
#include "core/types.hpp"
#include "core/vehicle/airframe.hpp"
#include "sim_server/flight/position_control.hpp"

namespace skein::sim {

/// Of the rotors in the order of rotor_hubs(); they turn in alternate directions.
using RotorSpeeds = std::array<double, kRotors>;  ///< [rad/s], >= 0

/// One UAV's controller. Not thread-safe.
class AttitudeController {
 public:
  struct Integrators {
    double roll = 0.0, pitch = 0.0;  ///< sums of errors [rad], within +-0.6
  };

  /// @param vehicle  arm, rotor constants and attitude_control are used. The inertia that the law believes in is a key
  ///                 of its own: the benchmark's law knows the body without rotors and LiDAR.
  explicit AttitudeController(const VehicleConfig& vehicle);

  /// Speeds that give the demanded torque and thrust. They are not limited from above (the motors are); a rotor
  /// that would have to pull down stands still.
  RotorSpeeds step(const Quaterniond& q_WB, const Vector3d& w_WB_B, const ControlDemand& demand);

  const Integrators& integrators() const { return integrators_; }
  void set_integrators(const Integrators& integrators) { integrators_ = integrators; }
  /// Angular acceleration asked for in the last step, expressed in B [rad/s^2].
  const Vector3d& angular_acceleration() const { return angular_acceleration_; }

 private:
  using Mixer = Eigen::Matrix<double, kRotors, 4>;

  AttitudeControlConfig gains_;
  Vector3d inertia_;
  Mixer mixer_;  ///< torques and thrust to squared speeds
  Integrators integrators_;
  Vector3d angular_acceleration_ = Vector3d::Zero();
};

}  // namespace skein::sim
