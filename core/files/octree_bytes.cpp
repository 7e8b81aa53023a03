#include "core/files/octree_bytes.hpp"

#include <array>
#include <cstdint>

namespace skein {
namespace {

constexpr int kTreeDepth = 16;
constexpr std::int64_t kKeyOfOrigin = 1 << 15;  ///< number of the smallest cell that begins at 0

/// Each inner node has two bytes, two bits for each child. The bytes of its inner children follow.
class OctreeWalk {
 public:
  OctreeWalk(std::string_view bytes, double cell_m, const std::function<void(const KnownCube&)>& visit)
      : bytes_(bytes), cell_m_(cell_m), visit_(visit) {}

  std::optional<std::size_t> nodes() {
    if (bytes_.empty()) return 0;
    nodes_ = 1;
    return inner({0, 0, 0}, 0) && at_ == bytes_.size() ? std::optional(nodes_) : std::nullopt;
  }

 private:
  using Key = std::array<std::int64_t, 3>;  ///< of a node: the number of its lowest smallest cell, along each axis

  bool inner(const Key& key, int depth) {
    if (depth == kTreeDepth || bytes_.size() - at_ < 2) return false;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<std::uint8_t>(bytes_[at_ + i])); };
    const unsigned children = byte(0) | byte(1) << 8;
    at_ += 2;
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned child = children >> (2 * i) & 3U;
      if (child == kNothing) continue;
      ++nodes_;
      if (child != kInner) leaf(child_key(key, depth, i), depth + 1, child == kOccupied);
    }
    for (unsigned i = 0; i < 8; ++i) {
      if ((children >> (2 * i) & 3U) == kInner && !inner(child_key(key, depth, i), depth + 1)) return false;
    }
    return true;
  }
  static Key child_key(const Key& key, int depth, unsigned child) {
    const std::int64_t edge = std::int64_t{1} << (kTreeDepth - depth - 1);
    return {key[0] + edge * (child & 1U), key[1] + edge * (child >> 1 & 1U), key[2] + edge * (child >> 2)};
  }
  void leaf(const Key& key, int depth, bool occupied) {
    const auto lowest = [&](std::size_t axis) { return cell_m_ * static_cast<double>(key[axis] - kKeyOfOrigin); };
    visit_({{lowest(0), lowest(1), lowest(2)}, cell_m_ * static_cast<double>(1 << (kTreeDepth - depth)), occupied});
  }

  static constexpr unsigned kNothing = 0, kOccupied = 2, kInner = 3;

  const std::string_view bytes_;
  const double cell_m_;
  const std::function<void(const KnownCube&)>& visit_;
  std::size_t at_ = 0, nodes_ = 0;
};

}  // namespace

std::optional<std::size_t> visit_octree(std::string_view bytes, double cell_m,
                                        const std::function<void(const KnownCube&)>& visit) {
  return OctreeWalk(bytes, cell_m, visit).nodes();
}

}  // namespace skein
