// What RayFan hands to its inside, ray_fan_kernel.hpp: plain arrays, since that is compiled for two instruction sets
// and must share no inline function with other files.
// Frames: W world, T the search tree's own axes, W turned about z.   Units: m.
#pragma once

#include <cstddef>
#include <cstdint>

namespace skein::sim::fan {

inline constexpr int kLanes = 8;
inline constexpr std::uint32_t kNoTriangle = 0xffffffffU;

/// A tile of neighbouring rays: sixteen rows of eight.
inline constexpr int kTileRows = 16, kTileColumns = kLanes;

/// Eight triangles. A lane without one holds three times the same point, which no ray meets.
struct alignas(32) Leaf {
  float corners_W[3][3][kLanes];  ///< [corner][axis]
  std::uint32_t triangles[kLanes];
};

/// Boxes of eight children along the axes of T. A lane without a child holds a box of negative size, which no ray
/// meets.
struct alignas(32) Branch {
  float centre_T[3][kLanes], half_T[3][kLanes];  ///< [axis]
  std::int32_t children[kLanes];                 ///< index of a branch, or ~index of a leaf
};

/// Deeper than this no tree is, so that a search needs this many places on its stack at most.
inline constexpr int kMostLevels = 57;
inline constexpr int kStackSize = kMostLevels * (kLanes - 1) + 1;

/// One trace of RayFan: a grid of rays from one point.
struct Job {
  const Branch* branches;  ///< the first one is the root
  const Leaf* leaves;
  float origin_W[3], origin_T[3];
  float slack;               ///< bound of the rounding errors in the place of a box [m]
  std::size_t columns;       ///< of the grid
  const float* directions;   ///< x, y, z of each ray, row by row
  const float* reaches;      ///< of each ray [m]
  std::uint32_t* triangles;  ///< of each ray: receives what it meets first, or kNoTriangle
};

/// The part of the grid that makes a tile.
struct Window {
  std::size_t row, column;
  int rows, columns;
  float axes_W[3][3], axes_T[3][3];  ///< unit vectors across the tile, along its columns, and ahead
};

/// Traces the rays of a window.   @returns false, with nothing done, when they point too far apart to make a tile;
///          never for a single ray.
bool trace_tile_sse2(const Job& job, const Window& window);  ///< for every x86-64
bool trace_tile_avx2(const Job& job, const Window& window);  ///< for CPUs with AVX2: twice as wide, the same bits

}  // namespace skein::sim::fan
