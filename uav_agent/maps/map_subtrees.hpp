// Conversion between chunks of a WorldMap and OctoMap's binary serialisation of an octree. join_subtrees() makes one
// complete tree, from the root on, that has only the given chunks: octomap::OcTree::readBinaryData() reads it, at the
// resolution of the map's smallest cubes. Free space is pruned into leaves with an edge of up to four chunks (16 m with
// cubes of 0.5 m), occupied space into leaves of up to one chunk. Unknown space takes no bytes.
// Frame W.   Units: smallest cubes of the map, chunks of 8^3 of them.   Pure.
// Bounded: a chunk takes up to 146 bytes, and read_subtrees() returns at most kMostHeardCubes for any input.
// Source: A. Hornung et al., OctoMap: An Efficient Probabilistic 3D Mapping Framework Based on Octrees, 2013. Format of
// octomap 1.9: each inner node has two bytes, two bits for each child; the nodes of its children follow.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// A chunk as a node of the octree.
struct Subtree {
  enum Kind : std::uint8_t { nothing = 0, free = 1, occupied = 2, inner = 3 };  ///< as OctoMap writes them

  Eigen::Vector3i chunk = Eigen::Vector3i::Zero();
  Kind kind = nothing;
  std::vector<std::uint8_t> bytes = {};  ///< if inner: this node and all inner nodes below it
};

/// Limits of read_subtrees(): chunks in one tree, and cubes that one tree may have. Memory.
inline constexpr std::size_t kMostJoined = 512, kMostHeardCubes = kMostJoined * MapLevel::kCells;

/// Whether OctoMap's tree contains this chunk: it reaches 16 km in each direction with cubes of 0.5 m.
bool within_tree(const Eigen::Vector3i& chunk);

Subtree subtree_of(const Eigen::Vector3i& chunk, const WorldMap::Chunk& known);

/// @param subtrees  different chunks within_tree(), in any order; up to kMostJoined if read_subtrees() is to take them.
/// @returns the tree; empty if there are none.
std::vector<std::uint8_t> join_subtrees(std::span<const Subtree> subtrees);

/// The free and occupied cubes of a tree; free ones as large as the map's levels allow, occupied ones of level 0.
/// @param levels  number of levels of the map that will take them, see WorldMap::levels().
/// @returns nullopt if the bytes are not a tree, or if it has larger leaves than join_subtrees() makes, or more than
/// kMostHeardCubes cubes.
std::optional<std::vector<HeardCube>> read_subtrees(std::span<const std::uint8_t> bytes, int levels);

}  // namespace skein::agent
