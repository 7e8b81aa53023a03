// Many rays from one point at once, as a LiDAR sends them: which triangle of the structure each of them meets first.
// How it works and what it costs: docs/decisions/0007-fan-of-rays.md.
// Frame W; metres.
//
// The same bits on every x86-64 CPU: every operation is a plain one of IEEE single precision, lane by lane, no fused
// multiply-add, no approximate reciprocal. How many lanes a CPU has does not matter to that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/scene.hpp"

namespace skein::sim {

class RayFan {
 public:
  /// Says that a ray meets nothing.
  static constexpr std::uint32_t kNothing = 0xffffffffU;

  /// Which instructions to use. `widest`: AVX2 where the CPU has it.
  enum class Width { sse2, widest };

  /// Builds a search tree: about 0.1 s per 100,000 triangles.
  /// @param mesh  structure, double-sided; copied. May be empty. Every triangle names vertices that exist.
  explicit RayFan(const TriangleMesh& mesh, Width width = Width::widest);
  ~RayFan();
  RayFan(RayFan&&) noexcept;
  RayFan& operator=(RayFan&&) noexcept;

  /// The first triangle on each ray. Watertight: a ray between two triangles that share an edge or a corner meets one
  /// of them. A triangle seen exactly edge-on, or without area, is not met.
  /// @param directions  unit vectors, row by row of a grid in which neighbours point to similar directions, each row
  ///                    and each column in one sense. Any list will do, at the price of speed.
  /// @param columns     length of a row, >= 1; divides the number of directions.
  /// @param reaches     as many, > 0, may be infinite; a ray ends there [m]. A triangle exactly at the end may or may
  ///                    not count.
  /// @param triangles   as many; receives indices of triangles, or kNothing.
  /// Const and safe from any number of threads.
  void trace(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions, std::size_t columns,
             std::span<const float> reaches, std::span<std::uint32_t> triangles) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace skein::sim
