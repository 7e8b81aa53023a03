// Attitude controller of a hexarotor: from demanded roll, pitch, yaw rate and thrust to six rotor speeds. Runs every
// physics tick. Frames: W world, B body (FLU).  Units: SI, radians.  Source: golden vectors `attitude_control`.
#pragma once

#include <array>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"
#include "core/vehicle/airframe.hpp"
#include "sim_server/flight/position_control.hpp"

namespace skein::sim {

/// Speeds of the rotors, in the order of rotor_hubs(); neighbouring rotors turn in opposite directions.
using RotorSpeeds = std::array<double, kRotors>;  ///< [rad/s], >= 0

/// One UAV's controller. Not thread-safe.
class AttitudeController {
 public:
  struct Integrators {
    double roll = 0.0, pitch = 0.0;  ///< sums of the errors of all ticks [rad], limited to +-0.6
  };

  /// @param vehicle  the controller uses arm, rotor constants and attitude_control. Its inertia is
  ///   attitude_control.inertia, because the benchmark's control law uses the body without rotors and LiDAR; if that
  ///   key is missing, vehicle.inertia.
  explicit AttitudeController(const VehicleConfig& vehicle);

  /// Rotor speeds for the demand, and one step of the integrators. Speeds have no upper limit here (the motors have
  /// one); a rotor that would have to push downwards gets 0.
  RotorSpeeds step(const Quaterniond& q_WB, const Vector3d& w_WB_B, const ControlDemand& demand);

  const Integrators& integrators() const { return integrators_; }
  void set_integrators(const Integrators& integrators) { integrators_ = integrators; }
  /// Angular acceleration demanded in the last step(), expressed in B [rad/s^2].
  const Vector3d& angular_acceleration() const { return angular_acceleration_; }

 private:
  using Mixer = Eigen::Matrix<double, kRotors, 4>;

  AttitudeControlConfig gains_;
  Vector3d inertia_;
  Mixer mixer_;  ///< maps torques in B and thrust to squared speeds
  Integrators integrators_;
  Vector3d angular_acceleration_ = Vector3d::Zero();
};

}  // namespace skein::sim
