// Keeps the angular momentum of a turning body through one step of a physics engine that knows angular velocity only
// (Bullet): its own gyroscopic terms cost a spinning body 2 % of its energy in a second. The engine turns the body at
// the velocity that belongs to the middle of the step, and what its forces and contacts added to that is added to the
// momentum.
// Frames: W world; P, whose axes are the body's principal axes of inertia.   Units: SI.   Threads: one.
#pragma once

#include "core/types.hpp"

namespace skein::sim {

class MomentumKeeper {
 public:
  /// Before the step. @param inertia  about the axes of P [kg m^2].   @param w_WP_W  expressed in W.
  MomentumKeeper(const Vector3d& inertia, const Matrix3d& R_WP, const Vector3d& w_WP_W, double step_s);
  /// At which the engine is to turn the body, expressed in W.
  const Vector3d& middle_velocity() const { return w_middle_W_; }
  /// After the step, with what the engine made of both. @returns the velocity that the momentum now amounts to, in W.
  Vector3d finish(const Matrix3d& R_WP, const Vector3d& w_WP_W);

 private:
  Vector3d momentum(const Matrix3d& R_WP, const Vector3d& w_W) const;
  Vector3d velocity(const Matrix3d& R_WP, const Vector3d& L_W) const;

  Vector3d inertia_;
  Matrix3d R_WP_;
  Vector3d L_W_, w_middle_W_;
};

}  // namespace skein::sim
