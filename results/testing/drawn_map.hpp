// For tests: random map files in OctoMap's format.
#pragma once

#include <array>
#include <random>
#include <string>

namespace skein::results {

/// A random octree as a file. Its leaves lie near the origin, at positive coordinates, and have edges of 0.5 m or more.
class DrawnMap {
 public:
  explicit DrawnMap(std::mt19937& random) : random_(random) {
    if (random_() % 8 != 0) add_inner(0);
  }
  std::string file() const {
    return "# Octomap OcTree binary file\n# (feel free to add / change comments)\n#\nid OcTree\nsize " +
           std::to_string(nodes_) + "\nres 0.5\ndata\n" + data_;
  }

 private:
  static constexpr int kDepth = 16, kNear = 9;  ///< at depth kNear, a cube has an edge of 64 m

  void add_inner(int depth) {
    if (depth == 0) nodes_ = 1;
    std::array<unsigned, 8> children{};
    if (depth < kNear) {
      children[depth == 0 ? 7 : 0] = 3;
    } else {
      for (unsigned& child : children) child = random_() % (depth + 1 < kDepth && random_() % 3 == 0 ? 4 : 3);
    }
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; ++i) {
      bits |= children[i] << (2 * i);
      nodes_ += children[i] == 0 ? 0 : 1;
    }
    data_ += static_cast<char>(bits & 255U);
    data_ += static_cast<char>(bits >> 8);
    for (const unsigned child : children) {
      if (child == 3) add_inner(depth + 1);
    }
  }

  std::mt19937& random_;
  std::string data_;
  std::size_t nodes_ = 0;
};

inline std::string drawn_map(std::mt19937& random) { return DrawnMap(random).file(); }

}  // namespace skein::results
