// Mass properties of a vehicle, and conversion of its motion to the frame of a physics engine: the centre of mass and
// the principal axes of inertia. Frames: W world (ENU); B body (FLU), whose origin Bo is the reference of odometry; P,
// with the centre of mass Bcm as origin and the principal axes as axes.  Units: SI.   Pure; safe from any thread.
#pragma once

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

struct MassFrame {
  double mass_kg = 0.0;
  Isometry3d X_BP = Isometry3d::Identity();
  Vector3d inertia = Vector3d::Zero();  ///< about the axes of P [kg m^2]
};
/// If the vehicle has no products of inertia, P has the axes of B.
MassFrame mass_frame(const VehicleConfig& vehicle);

/// The motion of P.
struct MassState {
  Vector3d p_WBcm = Vector3d::Zero();
  Quaterniond q_WP = Quaterniond::Identity();
  Vector3d v_WBcm = Vector3d::Zero();
  Vector3d w_WB = Vector3d::Zero();  ///< expressed in W
};
/// The motion of P from that of B, and the reverse.
MassState mass_state(const MassFrame& frame, const RigidBodyState& state);
RigidBodyState body_state(const MassFrame& frame, const MassState& state);

/// Torque about Bcm of a force that acts at Bo and a torque; all expressed in W [N m].
Vector3d torque_about_mass(const MassFrame& frame, const Quaterniond& q_WB, const Vector3d& force_W,
                           const Vector3d& torque_W);

}  // namespace skein::sim
