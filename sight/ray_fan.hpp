// Many rays from one point at once, as a LiDAR sends them: which triangle of the structure each of them hits first.
// Algorithm and costs: docs/decisions/0007-fan-of-rays.md.
// Frame W; metres.
//
// Gives the same bits on every x86-64 CPU, whatever the width of its registers: only basic operations in IEEE single
// precision, lane by lane, without fused multiply-add and without approximate reciprocals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/scenario/scene.hpp"

namespace skein::sim {

class RayFan {
 public:
  /// Result of a ray that hits nothing.
  static constexpr std::uint32_t kNothing = 0xffffffffU;

  /// The instruction set to use. `widest`: AVX2 if the CPU has it, else SSE2.
  enum class Width { sse2, widest };

  /// Builds a search tree: about 0.1 s per 100,000 triangles.
  /// @param mesh  structure, double-sided; copied. May be empty. All vertex indices must be valid.
  explicit RayFan(const TriangleMesh& mesh, Width width = Width::widest);
  ~RayFan();
  RayFan(RayFan&&) noexcept;
  RayFan& operator=(RayFan&&) noexcept;

  /// Finds the first triangle on each ray. Watertight: no ray passes between two triangles that share an edge or a
  /// corner. No ray hits a triangle that it sees exactly edge-on, or one without area.
  /// @param directions  unit vectors of a grid, row by row. Neighbours should point in similar directions, and the
  ///                    direction should turn one way along each row and column; other lists work, but are slower.
  /// @param columns     length of a row, >= 1; divides the number of directions.
  /// @param reaches     length of each ray [m], one per direction; > 0, may be infinite. A triangle exactly at the end
  ///                    of a ray may or may not count.
  /// @param triangles   one per direction; receives the index of a triangle, or kNothing.
  /// Const and safe from any number of threads.
  void trace(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions, std::size_t columns,
             std::span<const float> reaches, std::span<std::uint32_t> triangles) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace skein::sim
