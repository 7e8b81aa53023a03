// Three independent standard normal numbers.
#pragma once

#include "core/math/random_stream.hpp"
#include "core/types.hpp"

namespace skein {

inline Vector3d normals(RandomStream& draw) {
  const double x = draw.normal(), y = draw.normal();
  return {x, y, draw.normal()};
}

}  // namespace skein
