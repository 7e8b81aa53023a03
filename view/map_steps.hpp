// A UAV's map in time as a page is told it: when each cube came, and when it went again. At any time t the cubes that
// have come by t and have not gone are those of the newest snapshot that is not after t.
// Frame W.   Units: metres, seconds, cubes.   Pure; any thread.
// Bounded: of either kind a snapshot has kMostRuns rows, and all of them together have kMostRunsInTime.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "view/cube_runs.hpp"

namespace skein::view {

inline constexpr std::size_t kMostRunsInTime = 4 * kMostRuns;

/// Some cubes of one time.
struct RunsAt {
  double time_s = 0.0;
  std::vector<CubeRun> runs = {};  ///< joined
};

/// Cubes that came together and went together.
struct RunsStep {
  double time_s = 0.0;
  std::optional<double> until_s = {};  ///< none: they stayed
  std::vector<CubeRun> runs = {};      ///< joined
};

/// @param snapshots  their times rise. @returns by time; of those that came together the first to go first, and those
/// that stayed last.
std::vector<RunsStep> lifetimes(std::span<const RunsAt> snapshots);

struct MapInTime {
  double cell_m = 0.5, slice_cell_m = 0.5;  ///< as in ShownMap, the same for the whole time
  std::vector<double> times_s = {};         ///< of the snapshots
  std::vector<RunsStep> occupied = {}, free = {};
};

/// @param occupied, free  snapshots of the same times, in cubes of cell_m.
/// @param most_runs  of a snapshot. @param most_in_time  of all together. Larger cubes where there would be more.
MapInTime map_in_time(std::vector<RunsAt> occupied, std::vector<RunsAt> free, double cell_m,
                      std::size_t most_runs = kMostRuns, std::size_t most_in_time = kMostRunsInTime);

/// What a browser is told (Feed::set_cloud()). @param kind  which of a UAV's maps it is, for people.
std::string map_text(const std::string& uav, const MapInTime& map, const std::string& kind);

}  // namespace skein::view
