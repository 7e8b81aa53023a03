#include "uav_agent/maps/map_subtrees.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/files/octree_bytes.hpp"

namespace skein::agent {
namespace {

constexpr int kOctants = 8;  ///< geometry: children of an inner node
/// OctoMap's format.
constexpr int kTreeDepth = 16, kChunkDepth = kTreeDepth - MapLevel::kBlockBits;
constexpr int kLargestFreeDepth = kChunkDepth - 2;  ///< format: a free leaf has at most 2^2 chunks along an edge
constexpr int kChunkOfOrigin = 1 << (kChunkDepth - 1);

using Kind = Subtree::Kind;
static_assert(static_cast<int>(Space::unknown) == Subtree::nothing && static_cast<int>(Space::free) == Subtree::free &&
              static_cast<int>(Space::occupied) == Subtree::occupied);

/// Indices in a Chunk of a chunk's cubes in the order of the octree, three levels down. OctoMap numbers a child
/// x + 2 y + 4 z.
constexpr std::array<std::uint16_t, MapLevel::kCells> kPlaces = [] {
  std::array<std::uint16_t, MapLevel::kCells> places = {};
  for (unsigned child = 0; child < places.size(); ++child) {
    for (unsigned level = 0; level < 3; ++level) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        const unsigned bit = child >> (3 * level + axis) & 1U;
        places[child] = static_cast<std::uint16_t>(places[child] | bit << (level + 3 * axis));
      }
    }
  }
  return places;
}();

/// Kind of a node with these children, pruned if they are leaves of the same kind.
Kind joined(const Kind* children) {
  const bool alike = children[0] != Kind::inner &&
                     std::all_of(children + 1, children + kOctants, [&](Kind kind) { return kind == children[0]; });
  return alike ? children[0] : Kind::inner;
}

std::array<std::uint8_t, 2> node_of(const Kind* children) {
  unsigned two_bits_each = 0;
  for (int i = 0; i < kOctants; ++i) two_bits_each |= static_cast<unsigned>(children[i]) << (2 * i);
  return {static_cast<std::uint8_t>(two_bits_each), static_cast<std::uint8_t>(two_bits_each >> 8)};
}

void append_node(const Kind* children, std::vector<std::uint8_t>& bytes) {
  const std::array<std::uint8_t, 2> node = node_of(children);
  bytes.insert(bytes.end(), node.begin(), node.end());
}

/// Position of a chunk in the tree's order (Morton code): three bits for each depth.
std::uint64_t order_of(const Eigen::Vector3i& chunk) {
  std::uint64_t order = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto key = static_cast<std::uint64_t>(chunk[axis] + kChunkOfOrigin);
    for (int bit = 0; bit < kChunkDepth; ++bit) order |= (key >> bit & 1U) << (3 * bit + axis);
  }
  return order;
}

/// Writes the nodes above the chunks, and the chunks' subtrees below them.
class Joining {
 public:
  struct Leaf {
    std::uint64_t order = 0;
    const Subtree* subtree = nullptr;
  };

  /// @param leaves  sorted by `order`.
  explicit Joining(std::span<const Leaf> leaves) : leaves_(leaves) {
    if (!leaves.empty()) write(0);
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  /// Writes the node at this depth that contains the next leaf.
  Kind write(int depth) {
    const Leaf& leaf = leaves_[next_];
    if (depth == kChunkDepth) {
      const Subtree& subtree = *leaves_[next_++].subtree;
      bytes_.insert(bytes_.end(), subtree.bytes.begin(), subtree.bytes.end());
      return subtree.kind;
    }
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + 2);
    const int bits = 3 * (kChunkDepth - depth);
    std::array<Kind, kOctants> children = {};
    while (next_ < leaves_.size() && leaves_[next_].order >> bits == leaf.order >> bits) {
      const auto child = leaves_[next_].order >> (bits - 3) & 7U;
      children[child] = write(depth + 1);
    }
    if (depth >= kLargestFreeDepth && joined(children.data()) == Kind::free) {
      bytes_.resize(begin);
      return Kind::free;
    }
    std::ranges::copy(node_of(children.data()), bytes_.begin() + static_cast<std::ptrdiff_t>(begin));
    return Kind::inner;
  }

  const std::span<const Leaf> leaves_;
  std::size_t next_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

bool within_tree(const Eigen::Vector3i& chunk) {
  return chunk.minCoeff() >= -kChunkOfOrigin && chunk.maxCoeff() < kChunkOfOrigin;
}

Subtree subtree_of(const Eigen::Vector3i& chunk, const WorldMap::Chunk& known) {
  std::array<Kind, 512> cubes;
  std::array<Kind, 64> twos;
  std::array<Kind, 8> fours;
  for (std::size_t i = 0; i < cubes.size(); ++i) cubes[i] = static_cast<Kind>(known[kPlaces[i]].space);
  for (std::size_t i = 0; i < twos.size(); ++i) twos[i] = joined(&cubes[kOctants * i]);
  for (std::size_t i = 0; i < fours.size(); ++i) fours[i] = joined(&twos[kOctants * i]);
  Subtree subtree{chunk, joined(fours.data())};
  if (subtree.kind != Kind::inner) return subtree;
  append_node(fours.data(), subtree.bytes);
  for (std::size_t i = 0; i < fours.size(); ++i) {
    if (fours[i] != Kind::inner) continue;
    append_node(&twos[kOctants * i], subtree.bytes);
    for (std::size_t j = kOctants * i; j < kOctants * (i + 1); ++j) {
      if (twos[j] == Kind::inner) append_node(&cubes[kOctants * j], subtree.bytes);
    }
  }
  return subtree;
}

std::vector<std::uint8_t> join_subtrees(std::span<const Subtree> subtrees) {
  std::vector<Joining::Leaf> leaves;
  leaves.reserve(subtrees.size());
  for (const Subtree& subtree : subtrees) {
    if (subtree.kind != Kind::nothing) leaves.push_back({order_of(subtree.chunk), &subtree});
  }
  std::ranges::sort(leaves, {}, &Joining::Leaf::order);
  return Joining(leaves).take();
}

std::optional<std::vector<HeardCube>> read_subtrees(std::span<const std::uint8_t> bytes, int levels) {
  std::vector<HeardCube> cubes;
  bool sound = true;
  const auto take = [&](const KnownCube& leaf) {  // lengths are in cubes
    const auto edge = static_cast<int>(leaf.edge_m);
    const int largest = leaf.occupied ? WorldMap::kChunk : WorldMap::kChunk << (kChunkDepth - kLargestFreeDepth);
    int level = 0;
    while (!leaf.occupied && level + 1 < levels && 2 << level <= edge) ++level;
    const int count = std::min(edge, largest) >> level;  // cubes along each edge
    const auto all = static_cast<std::size_t>(count) * static_cast<std::size_t>(count * count);
    sound = sound && edge <= largest && cubes.size() + all <= kMostHeardCubes;
    if (!sound) return;
    const Eigen::Vector3i lowest = (leaf.lowest_W / (1 << level)).cast<int>();
    for (int i = 0; i < count * count * count; ++i) {
      const Eigen::Vector3i cube = lowest + Eigen::Vector3i(i % count, i / count % count, i / (count * count));
      cubes.push_back({cube, level, leaf.occupied ? Space::occupied : Space::free});
    }
  };
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!visit_octree(text, 1.0, take) || !sound) return std::nullopt;
  return cubes;
}

}  // namespace skein::agent
