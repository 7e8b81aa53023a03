// A UAV's map for the page: runs of occupied cubes, and runs of free cubes in one horizontal slice. A run is a row of
// adjacent cubes along x. Frame W.   Units: metres, cubes.   Pure; any thread.
// Bounded: a map has at most kMostRuns runs of either kind, for any octree.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace skein::view {

inline constexpr std::size_t kMostRuns = 10'000;
/// The least limit on the number of runs: a map may need four rows, because cubes on different sides of y = 0 or z = 0
/// never become one cube, however large they are made.
inline constexpr std::size_t kLeastRuns = 4;

/// The cubes x to x + length - 1 of the row (y, z).
struct CubeRun {
  int x = 0, y = 0, z = 0;
  int length = 1;
  bool operator==(const CubeRun&) const = default;
};

struct ShownMap {
  double cell_m = 0.5;  ///< edge of an occupied cube: that of the octree's smallest cells, or 2, 4, ... times as large
  std::vector<CubeRun> occupied = {};
  double slice_cell_m = 0.5, slice_m = 0.0;  ///< edge of a free cube, and height of the slice
  std::vector<CubeRun> free = {};            ///< the free cubes that contain this height
};

/// Merges runs that touch or overlap. @returns the fewest runs with the same cubes, ordered by (z, y, x).
std::vector<CubeRun> joined_runs(std::vector<CubeRun> runs);
/// The cubes twice as large that contain any of these cubes, as joined runs.
std::vector<CubeRun> coarser_runs(const std::vector<CubeRun>& runs);

/// @param octree  in OctoMap's binary serialisation. @param cell_m  edge of its smallest cells.
/// @param slice_m  height of the slice of free cubes.
/// @param most_runs  of either kind, at least kLeastRuns; with more, the cubes of that kind are made larger.
/// @returns nullopt when the octree is damaged, or describes more space than a UAV can have seen.
std::optional<ShownMap> shown_map(std::string_view octree, double cell_m, double slice_m,
                                  std::size_t most_runs = kMostRuns);

/// @param runs  joined. @returns base64; a run takes about two bytes. web/src/packed.js decodes it.
std::string packed(std::span<const CubeRun> runs);

/// The text of a map for Feed::set_cloud(). @param kind  for people: which of the UAV's maps it is.
std::string map_text(const std::string& uav, double time_s, const ShownMap& map, const std::string& kind);
/// The text to send if there is no map. @param why  for people
std::string no_map_text(const std::string& uav, double time_s, const std::string& why);

}  // namespace skein::view
