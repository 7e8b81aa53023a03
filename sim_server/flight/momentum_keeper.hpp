// Conserves a rotating body's angular momentum over one step of a physics engine that integrates only angular velocity
// (Bullet): with Bullet's own gyroscopic terms, a spinning body loses 2 % of its energy per second. Midpoint rule:
// Bullet rotates the body with the angular velocity at the middle of the step. Afterwards, the momentum changes by the
// change of velocity that Bullet's torques and contacts have caused in the step.
// Frames: W world; P, whose axes are the body's principal axes of inertia.   Units: SI.   Threads: one.
#pragma once

#include "core/types.hpp"

namespace skein::sim {

class MomentumKeeper {
 public:
  /// Call it before the step. @param inertia  principal moments, about the axes of P [kg m^2].   @param w_WP_W  in W.
  MomentumKeeper(const Vector3d& inertia, const Matrix3d& R_WP, const Vector3d& w_WP_W, double step_s);
  /// Angular velocity that the engine must use in this step, expressed in W [rad/s].
  const Vector3d& middle_velocity() const { return w_middle_W_; }
  /// Call it after the step, with the engine's results. @returns the angular velocity for the new momentum, expressed
  /// in W [rad/s].
  Vector3d finish(const Matrix3d& R_WP, const Vector3d& w_WP_W);

 private:
  Vector3d momentum(const Matrix3d& R_WP, const Vector3d& w_W) const;
  Vector3d velocity(const Matrix3d& R_WP, const Vector3d& L_W) const;

  Vector3d inertia_;
  Matrix3d R_WP_;
  Vector3d L_W_, w_middle_W_;
};

}  // namespace skein::sim
