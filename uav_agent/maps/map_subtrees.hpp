// Chunks of a WorldMap as OctoMap serialises an octree in binary, and back. What is joined is one tree from its root
// on, with nothing but these chunks in it: octomap::OcTree::readBinaryData() reads it alone, at the resolution of the
// map's smallest cubes. Free space is pruned into leaves of up to four chunks (16 m with cubes of 0.5 m), occupied
// cubes up to one. What is unknown takes no bytes.
// Frame W.   Units: smallest cubes of the map, chunks of 8^3 of them.   Pure.
// Bounded: a chunk takes up to 146 bytes, and what is read comes to no more than kMostHeardCubes, whatever was sent.
// Source: A. Hornung et al., OctoMap: An Efficient Probabilistic 3D Mapping Framework Based on Octrees, 2013; the
// format as in octomap 1.9: of each inner node two bytes, two bits a child, before those of its children.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// A chunk as a node of the tree.
struct Subtree {
  enum Kind : std::uint8_t { nothing = 0, free = 1, occupied = 2, inner = 3 };  ///< as OctoMap writes them

  Eigen::Vector3i chunk = Eigen::Vector3i::Zero();
  Kind kind = nothing;
  std::vector<std::uint8_t> bytes = {};  ///< of an inner node and of those in it
};

/// Of chunks in one tree, and of cubes that they come to.
inline constexpr std::size_t kMostJoined = 512, kMostHeardCubes = kMostJoined * MapLevel::kCells;

/// Whether OctoMap's tree reaches so far: 16 km with cubes of 0.5 m.
bool within_tree(const Eigen::Vector3i& chunk);

Subtree subtree_of(const Eigen::Vector3i& chunk, const WorldMap::Chunk& known);

/// @param subtrees  different chunks within_tree(), in any order; up to kMostJoined if read_subtrees() is to take them.
/// @returns the tree; empty if there are none.
std::vector<std::uint8_t> join_subtrees(std::span<const Subtree> subtrees);

/// What a tree says, in cubes of the largest levels that a map has.
/// @param levels  of the map that is to take it in.
/// @returns nullopt when it is no tree, or one that join_subtrees() does not write: with larger leaves, or more cubes.
std::optional<std::vector<HeardCube>> read_subtrees(std::span<const std::uint8_t> bytes, int levels);

}  // namespace skein::agent
