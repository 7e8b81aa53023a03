// A UAV's map as a page is told it: rows of occupied cubes, and of free ones in one level slice. Rows run along x.
// Frame W.   Units: metres, cubes.   Pure; any thread.
// Bounded: whatever the tree says, a map has no more than kMostRuns rows of either kind.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace skein::view {

inline constexpr std::size_t kMostRuns = 10'000;

/// Cubes x to x + length - 1 of a row.
struct CubeRun {
  int x = 0, y = 0, z = 0;
  int length = 1;
  bool operator==(const CubeRun&) const = default;
};

struct ShownMap {
  double cell_m = 0.5;  ///< edge of an occupied cube: that of the tree, or twice, four times ... as large
  std::vector<CubeRun> occupied = {};
  double slice_cell_m = 0.5, slice_m = 0.0;  ///< edge of a free cube, and the height at which they were asked for
  std::vector<CubeRun> free = {};            ///< that hold this height
};

/// In the order of their rows (z, y, x), and as few as can be.
std::vector<CubeRun> joined_runs(std::vector<CubeRun> runs);
/// Cubes twice as large, wherever there is one of these; joined.
std::vector<CubeRun> coarser_runs(const std::vector<CubeRun>& runs);

/// @param octree  as OctoMap serialises it. @param cell_m  edge of its smallest cells.
/// @param slice_m  at this height free space is wanted. @param most_runs  larger cubes where there would be more.
/// @returns nullopt when it is no whole tree, or tells of more than any UAV can have seen.
std::optional<ShownMap> shown_map(std::string_view octree, double cell_m, double slice_m,
                                  std::size_t most_runs = kMostRuns);

/// @param runs  joined. @returns base64: a row takes two bytes or so. web/src/packed.js reads it.
std::string packed(std::span<const CubeRun> runs);

/// What a browser is told (Feed::set_cloud()). @param kind  which of a UAV's maps it is, for people.
std::string map_text(const std::string& uav, double time_s, const ShownMap& map, const std::string& kind);
/// In its place where there is no map. @param why  for people
std::string no_map_text(const std::string& uav, double time_s, const std::string& why);

}  // namespace skein::view
