// Where the gimbal must stand for the camera to look at a point, and how far off it is.
// Frames: W world, B body, C camera; angles as in GimbalState (core/types.hpp).   Units: SI and radians.   Pure.
#pragma once

#include <optional>

#include "core/scenario.hpp"
#include "core/types.hpp"

namespace skein::agent {

/// Gimbal angles that put p_W into the middle of the image, as near as the gimbal's limits allow.
GimbalCommand aim_at(const Vector3d& p_W, const RigidBodyState& state, const VehicleConfig& vehicle);

/// Yaw of a body that looks straight at a face.   @param out_W  the face's outward unit normal.
/// @returns nullopt for one that faces up or down: any yaw will do.
std::optional<double> yaw_facing(const Vector3d& out_W);

/// Angle between the camera's optical axis and its direction once it has been aimed at p_W.
double aim_error(const Vector3d& p_W, const RigidBodyState& state, const GimbalState& gimbal,
                 const VehicleConfig& vehicle);

}  // namespace skein::agent
