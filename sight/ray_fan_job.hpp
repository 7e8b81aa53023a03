// The input of RayFan's kernel (ray_fan_kernel.hpp). All data are plain arrays: the kernel is compiled for two
// instruction sets, and must share no inline function with other files.
// Frames: W world; T has the axes of the search tree (W turned about z).   Units: m.
#pragma once

#include <cstddef>
#include <cstdint>

namespace skein::sim::fan {

inline constexpr int kLanes = 8;
inline constexpr std::uint32_t kNoTriangle = 0xffffffffU;

/// A tile of neighbouring rays: sixteen rows of eight.
inline constexpr int kTileRows = 16, kTileColumns = kLanes;

/// Eight triangles. An empty lane holds a triangle with three equal corners, which no ray hits.
struct alignas(32) Leaf {
  float corners_W[3][3][kLanes];  ///< [corner][axis]
  std::uint32_t triangles[kLanes];
};

/// Boxes of eight children along the axes of T. An empty lane holds a box of negative size, which no ray hits.
struct alignas(32) Branch {
  float centre_T[3][kLanes], half_T[3][kLanes];  ///< [axis]
  std::int32_t children[kLanes];                 ///< index of a branch, or ~index of a leaf
};

/// Greatest depth of a tree (see kLevelsBySurface in ray_fan_tree.cpp), and the stack size that a search then needs.
inline constexpr int kMostLevels = 57;
inline constexpr int kStackSize = kMostLevels * (kLanes - 1) + 1;

/// One call of RayFan::trace(): a grid of rays from one point.
struct Job {
  const Branch* branches;  ///< the first one is the root
  const Leaf* leaves;
  float origin_W[3], origin_T[3];
  float slack;               ///< bound of the rounding errors of a box's position [m]
  std::size_t columns;       ///< of the grid
  const float* directions;   ///< x, y, z of each ray, row by row
  const float* reaches;      ///< of each ray [m]
  std::uint32_t* triangles;  ///< for each ray: receives the first triangle that it hits, or kNoTriangle
};

/// The part of the grid that one tile covers.
struct Window {
  std::size_t row, column;
  int rows, columns;
  float axes_W[3][3], axes_T[3][3];  ///< unit vectors across the tile, along its columns, and ahead
};

/// Traces the rays of a window.   @returns false, with no result written, if the directions of the rays differ too much
///          to form a tile; never for a single ray.
bool trace_tile_sse2(const Job& job, const Window& window);  ///< for every x86-64 CPU
bool trace_tile_avx2(const Job& job, const Window& window);  ///< for CPUs with AVX2: twice the width, the same bits

}  // namespace skein::sim::fan
