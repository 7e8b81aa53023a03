#include "uav_agent/maps/map_tree.hpp"

namespace skein::agent {

bool MapTree::update(const WorldMap& map) {
  regions_.resize(map.regions().size());
  bool changed = false;
  WorldMap::Chunk known;
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    Region& region = regions_[i];
    const std::uint64_t region_changed_at = map.region_changed_at(map.regions()[i]);
    if (region_changed_at == region.changed_at) continue;
    region.changed_at = region_changed_at;
    const WorldMap::ChunksChangedAt& chunks_changed_at = map.chunks_changed_at(map.regions()[i]);
    for (int j = 0; j < WorldMap::kRegionChunks; ++j) {
      const auto place = static_cast<std::size_t>(j);
      const Eigen::Vector3i chunk = WorldMap::chunk_of(map.regions()[i], j);
      const std::uint64_t changed_at = chunks_changed_at[place];
      if (changed_at == region.chunks_changed_at[place] || !within_tree(chunk)) continue;
      region.chunks_changed_at[place] = changed_at;
      if (region.subtrees[place] == 0) {
        subtrees_.emplace_back();
        region.subtrees[place] = static_cast<std::uint32_t>(subtrees_.size());
      }
      map.read(chunk, known);
      subtrees_[region.subtrees[place] - 1] = subtree_of(chunk, known);
      changed = true;
    }
  }
  return changed;
}

}  // namespace skein::agent
