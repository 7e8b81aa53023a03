// Gimbal angles that point the camera at a point, and the error of the present angles.
// Frames: W world, B body, C camera; angles as in GimbalState (core/types.hpp).   Units: SI and radians.   Pure.
#pragma once

#include <optional>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::agent {

/// Gimbal angles that put p_W into the middle of the image, clamped to the gimbal's limits.
GimbalCommand aim_at(const Vector3d& p_W, const RigidBodyState& state, const VehicleConfig& vehicle);

/// Yaw of a body that faces a face of a box.   @param out_W  the face's outward unit normal.
/// @returns nullopt for a face that faces up or down (|z| >= 0.5): any yaw will do.
std::optional<double> yaw_facing(const Vector3d& out_W);

/// Angle between the camera's present optical axis and its axis at the angles of aim_at() [rad].
double aim_error(const Vector3d& p_W, const RigidBodyState& state, const GimbalState& gimbal,
                 const VehicleConfig& vehicle);

}  // namespace skein::agent
