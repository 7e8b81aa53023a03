// Estimates the displacement and the velocity of a UAV that are due to the wind: the response of its position
// controller, taken as linear, to the force that the wind adds. Only the explanation of losses uses it
// (docs/results.md): without wind, the UAV would be at p_WB - offset_W() with the velocity v_WB - velocity_W(). The
// model takes the attitude loop (14 rad/s; position loop: 2 rad/s) as immediate, and the wind's torque as balanced.
// Frame: W world.  Units: SI.  Pure; threads: one.
#pragma once

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

class WindPush {
 public:
  explicit WindPush(const VehicleConfig& vehicle);

  /// Advances the estimate by one time step. @param force_W  force on the UAV, less the force in still air [N].
  void step(const Vector3d& force_W, double step_s);

  const Vector3d& offset_W() const { return p_W_; }
  const Vector3d& velocity_W() const { return v_W_; }

 private:
  double mass_kg_;
  Vector3d stiffness_, damping_, integral_gain_;
  Vector3d p_W_ = Vector3d::Zero(), v_W_ = Vector3d::Zero();
  Vector3d error_sum_ = Vector3d::Zero();  ///< the controller's sum of the position error over its steps [m]
};

}  // namespace skein::sim
