// What stands in the world: triangles, interest points and boxes. Frame W; metres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace skein {

/// Indexed triangles. Geometry is double-sided: nothing may depend on the winding.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Scene {
  TriangleMesh mesh;  ///< all structures together
  std::vector<InterestPoint> points;
  std::vector<OrientedBox> boxes;  ///< all that a UAV is told
};

}  // namespace skein
