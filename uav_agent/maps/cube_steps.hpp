// Steps from a cube or cell of a grid to those around it, and to the corners of a cube of twice the edge.
// Pure; threads: any.
#pragma once

#include "core/types.hpp"

namespace skein::agent {

inline constexpr int kCubesAround = 27;  ///< geometry: 3^3, the cube itself included
inline constexpr int kCubeCorners = 8;   ///< geometry: 2^3

/// The i-th step to the cubes around a cube, x first: -1, 0 or 1 along each axis. Geometry: 13 is no step.
inline Eigen::Vector3i step_around(int i) { return {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}; }

/// The i-th corner of a cube, x first: 0 or 1 along each axis.
inline Eigen::Vector3i corner_step(int i) { return {i & 1, i >> 1 & 1, i >> 2}; }

}  // namespace skein::agent
