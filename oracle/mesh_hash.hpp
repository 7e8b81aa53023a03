// Adds the triangles of a mesh to a hash that is the key of a cached result.   Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scenario/scene.hpp"
#include "core/text/sha256.hpp"

namespace skein::sim {

/// Adds the numbers of vertices and triangles, and their bytes. @param mesh  in any frame.
inline void add_mesh(Sha256& hash, const TriangleMesh& mesh) {
  const auto add = [&](const auto& values) {
    hash.add(values.size());
    hash.add(std::span(reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(values[0])));
  };
  add(mesh.vertices);
  add(mesh.triangles);
}

}  // namespace skein::sim
