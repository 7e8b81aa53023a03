// Interest points on the surfaces of a scene: evenly spread, and only where a camera outside can see them.
// Frame: W.   Units: m.   Pure; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scenario/scene.hpp"

namespace skein::sim {

/// A scene that a procedural family has built, still without interest points.
struct UnsampledScene {
  Scene scene;
  std::size_t point_count = 0;
  std::uint64_t seed = 0;
};

/// Must be increased with every change after which sample_surface() may give other points for the same arguments:
/// caches contain its earlier results.
inline constexpr int kSamplingVersion = 1;

/// Samples points on the triangles inside the boxes, with the triangles' normals. All surfaces get points in proportion
/// to their area, including thin members and both sides of thin plates. No two points are much closer than the mean
/// spacing, unless they face in opposite directions.
///
/// Leaves out points that no camera could see: those inside another solid, covered by one within 0.4 m, lower than
/// 0.3 m above the ground, or without an unobstructed view of 4.5 m to a place with room for a UAV.
/// The result depends on nothing but the arguments.
/// @param mesh   closed surfaces with outward winding; they may overlap.
/// @param count  number of points. The result has fewer if the surfaces have no room for more; this does not happen at
///               sensible densities.
/// @param seed   key of the random numbers.
std::vector<InterestPoint> sample_surface(const TriangleMesh& mesh, std::span<const OrientedBox> boxes,
                                          std::size_t count, std::uint64_t seed);

/// The scene with its interest points, from sample_surface().
Scene sampled(UnsampledScene unsampled);

}  // namespace skein::sim
