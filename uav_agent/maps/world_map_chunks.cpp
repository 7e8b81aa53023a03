// What the world map knows of the cubes of a chunk. As in known(), the smallest cubes decide, and larger cubes tell
// about the cubes that are unknown among the smaller ones.
#include <algorithm>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {
namespace {

/// Sets the unknown cubes within a larger cube of a chunk.   @param lowest  the lowest smallest cube in it.
/// @param edge  in smallest cubes.
void fill_unknown(WorldMap::Chunk& known, const Eigen::Vector3i& lowest, int edge, const MapLevel::Known& about) {
  for (int z = 0; z < edge; ++z) {
    for (int y = 0; y < edge; ++y) {
      const std::size_t first = MapLevel::place_of(lowest + Eigen::Vector3i(0, y, z));
      for (std::size_t place = first; place < first + static_cast<std::size_t>(edge); ++place) {
        if (known[place].space == Space::unknown) known[place] = about;
      }
    }
  }
}

}  // namespace

CellRows WorldMap::rows(const Cube& chunk, Space space) const {
  CellRows rows = levels_.front()->rows(chunk, space), unknown = levels_.front()->rows(chunk, Space::unknown);
  for (int i = 1; i < levels(); ++i) {
    if (std::ranges::all_of(unknown, [](std::uint8_t row) { return row == 0; })) break;
    const Cube block = shifted(chunk, i), corner = (chunk - block * (1 << i)) * (kChunk >> i);
    const MapLevel& level = *levels_[static_cast<std::size_t>(i)];
    const CellRows larger = level.rows(block, space), larger_unknown = level.rows(block, Space::unknown);
    for (int row = 0; row < kChunk * kChunk; ++row) {
      const auto at = static_cast<std::size_t>(row);
      const int y = corner.y() + (row % kChunk >> i), z = corner.z() + (row / kChunk >> i);
      const auto around = static_cast<std::size_t>(z * kChunk + y);
      if (space != Space::unknown) rows[at] |= unknown[at] & row_within(larger[around], corner.x(), i);
      unknown[at] &= row_within(larger_unknown[around], corner.x(), i);
    }
  }
  return space == Space::unknown ? unknown : rows;
}

void WorldMap::read(const Cube& chunk, Chunk& known) const {
  levels_.front()->read(chunk, known);
  Chunk larger;
  for (int i = 1; i < levels(); ++i) {
    if (std::ranges::all_of(known, [](const auto& cube) { return cube.space != Space::unknown; })) return;
    const Cube block = shifted(chunk, i);
    levels_[static_cast<std::size_t>(i)]->read(block, larger);
    const int count = kChunk >> i;                           // cells of this level along an edge of the chunk
    const Cube corner = (chunk - block * (1 << i)) * count;  // lowest cell of the chunk, within the block
    for (int at = 0; at < count * count * count; ++at) {
      const Cube cell(at % count, at / count % count, at / (count * count));
      const MapLevel::Known& about = larger[MapLevel::place_of(corner + cell)];
      if (about.space != Space::unknown) fill_unknown(known, cell * (1 << i), 1 << i, about);
    }
  }
}

}  // namespace skein::agent
