// A whole WorldMap as one octree in OctoMap's binary serialisation, for viewers and files. An update reads only the
// chunks that have changed since the last one.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
// Bounded: some 100 bytes for each chunk of the map.
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
  /// The tree at the last update(); its resolution is that of the map's smallest cubes.
  std::vector<std::uint8_t> bytes() const { return join_subtrees(subtrees_); }

 private:
  struct Region {
    std::uint64_t changed_at = 0;
    std::array<std::uint64_t, WorldMap::kRegionChunks> chunks_changed_at = {};
    std::array<std::uint32_t, WorldMap::kRegionChunks> subtrees = {};  ///< index in subtrees_, plus 1; 0: none
  };

  std::vector<Region> regions_;  ///< in the order of WorldMap::regions()
  std::vector<Subtree> subtrees_;
};

}  // namespace skein::agent
