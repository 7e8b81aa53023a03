// How far the wind alone pushes a UAV away, and how fast: the answer of its position controller, taken as linear, to
// the force that the wind adds. Only the explanation of losses uses it (docs/results.md): a UAV without wind would have
// been at p_WB - offset_W() with the velocity v_WB - velocity_W(). The attitude loop, with 14 rad/s far above the
// position loop's 2, is taken as immediate, and the torque of the wind as balanced.
// Frame: W world.  Units: SI.  Pure; threads: one.
#pragma once

#include "core/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

class WindPush {
 public:
  explicit WindPush(const VehicleConfig& vehicle);

  /// A time step later. @param force_W  by which the force on the UAV exceeds that in still air.
  void step(const Vector3d& force_W, double step_s);

  const Vector3d& offset_W() const { return p_W_; }
  const Vector3d& velocity_W() const { return v_W_; }

 private:
  double mass_kg_;
  Vector3d stiffness_, damping_, integral_gain_;
  Vector3d p_W_ = Vector3d::Zero(), v_W_ = Vector3d::Zero();
  Vector3d error_sum_ = Vector3d::Zero();  ///< the controller's: it grows by the error at each of its steps [m]
};

}  // namespace skein::sim
