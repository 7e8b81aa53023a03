// The contents of the world: structure as triangles, interest points, and boxes. Frame W; metres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace skein {

/// Indexed triangles. Triangles are double-sided: no code may depend on the order of their vertices.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Scene {
  TriangleMesh mesh;  ///< all structures together
  std::vector<InterestPoint> points;
  std::vector<OrientedBox> boxes;  ///< the only part of the scene that agents receive
};

}  // namespace skein
