// Interest points on the surfaces of a scene: evenly spread, and only where a camera outside can see them.
// Frame: W.   Units: m.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene.hpp"

namespace skein::sim {

/// What a procedural family builds: its points are still to be drawn.
struct UnsampledScene {
  Scene scene;
  std::size_t point_count = 0;
  std::uint64_t seed = 0;
};

/// Goes up whenever sample_surface() may draw other points for the same arguments: caches have what it drew before.
inline constexpr int kSamplingVersion = 1;

/// Sample points on the triangles inside the boxes, with the triangles' true normals. All surfaces get their share by
/// area, thin members and both sides of thin plates too. Of points that face the same way no two are much closer than
/// the mean spacing.
///
/// Left out are points that no camera could see: inside another solid, covered by one within 0.4 m, lower than 0.3 m
/// above the ground, or without a free view of some metres from a place with room for a UAV.
/// The result depends on nothing but the arguments.
/// @param mesh   closed surfaces with outward winding; they may overlap.
/// @param count  as many points, unless the surfaces have room for fewer (they do not at sensible densities).
/// @param seed   key of the random numbers.
std::vector<InterestPoint> sample_surface(const TriangleMesh& mesh, std::span<const OrientedBox> boxes,
                                          std::size_t count, std::uint64_t seed);

/// The same, into the scene.
Scene sampled(UnsampledScene unsampled);

}  // namespace skein::sim
