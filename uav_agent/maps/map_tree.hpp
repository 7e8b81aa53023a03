// A whole WorldMap as one octree in OctoMap's binary serialisation, for who looks on: what has not changed since it was
// last looked at is not read again.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
// Bounded: some 100 bytes a chunk of the map.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "uav_agent/maps/map_subtrees.hpp"

namespace skein::agent {

class MapTree {
 public:
  /// @param map  the same at each call. @returns whether anything has changed since the last one.
  bool update(const WorldMap& map);
  /// As it was then; cells are those of the map.
  std::vector<std::uint8_t> bytes() const { return join_subtrees(subtrees_); }

 private:
  struct Region {
    std::uint64_t changed_at = 0;
    std::array<std::uint64_t, WorldMap::kRegionChunks> chunks_changed_at = {};
    std::array<std::uint32_t, WorldMap::kRegionChunks> subtrees = {};  ///< in subtrees_, from 1 on; 0: none yet
  };

  std::vector<Region> regions_;  ///< as WorldMap::regions()
  std::vector<Subtree> subtrees_;
};

}  // namespace skein::agent
