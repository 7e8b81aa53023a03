// A UAV's map over time for the page: when each cube appears in the map, and when it disappears. The cubes that are
// present at a time t are those of the newest snapshot that is not later than t.
// Frame W.   Units: metres, seconds, cubes.   Pure; any thread.
// Bounded: of either kind (occupied, free), a snapshot has kMostRuns runs, and all snapshots have kMostRunsInTime.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "view/cube_runs.hpp"

namespace skein::view {

inline constexpr std::size_t kMostRunsInTime = 4 * kMostRuns;

/// The cubes of one snapshot.
struct RunsAt {
  double time_s = 0.0;
  std::vector<CubeRun> runs = {};  ///< joined
};

/// Cubes that appear together and disappear together.
struct RunsStep {
  double time_s = 0.0;                 ///< when they appear
  std::optional<double> until_s = {};  ///< when they disappear; none: never
  std::vector<CubeRun> runs = {};      ///< joined
};

/// @param snapshots  in ascending order of time. @returns ordered by time_s, then by until_s; those without until_s are
/// last among those of the same time_s.
std::vector<RunsStep> lifetimes(std::span<const RunsAt> snapshots);

struct MapInTime {
  double cell_m = 0.5, slice_cell_m = 0.5;  ///< as in ShownMap, the same for the whole time
  std::vector<double> times_s = {};         ///< of the snapshots
  std::vector<RunsStep> occupied = {}, free = {};
};

/// @param occupied, free  snapshots of the same times, in cubes of cell_m.
/// @param most_runs  of a snapshot. @param most_in_time  of all snapshots. With more runs, the cubes are made larger.
MapInTime map_in_time(std::vector<RunsAt> occupied, std::vector<RunsAt> free, double cell_m,
                      std::size_t most_runs = kMostRuns, std::size_t most_in_time = kMostRunsInTime);

/// The text of the map for Feed::set_cloud(). @param kind  for people: which of the UAV's maps it is.
std::string map_text(const std::string& uav, const MapInTime& map, const std::string& kind);

}  // namespace skein::view
