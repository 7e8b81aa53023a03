// LiDAR points and maps of a finished run, as far as its results folder has them: each UAV's map over time
// (map_files.hpp), else the map at its end; and LiDAR points if the recording has clouds (--record=clouds).
// Frame W.   Threads: one.   Bounded: kMostPointsKept points per UAV.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/run_record.hpp"
#include "view/feed.hpp"
#include "view/map_steps.hpp"
#include "view/scan_points.hpp"
#include "view/story.hpp"

namespace skein::view {

/// By UAV: its height [m] by time [s].
using Heights = std::vector<std::map<double, double>>;

class KeptClouds {
 public:
  static constexpr std::size_t kMostPointsKept = 30'000;

  /// Reads the folder; damaged files count as missing. @param run  of this folder; must outlive this.
  /// @param heights  of the whole run: the levels at which free space of the maps over time is shown.
  KeptClouds(const std::filesystem::path& dir, const results::RunRecord& run, const Heights& heights = {});

  /// Adds all points and maps to the feed. @param last  the fleet at the end of the run: its heights are the levels at
  /// which free space of maps without time is shown.
  void tell(std::span<const ShownUav> last, Feed& feed) const;

  std::vector<std::string> lidar = {};  ///< names of UAVs with LiDAR points
  std::vector<std::string> maps = {};   ///< names of UAVs with a map
  std::string missing = {};             ///< for people: what is missing, and how to get it; empty: nothing

 private:
  void read_recording(const std::filesystem::path& file);
  void say_what_is_missing(const std::filesystem::path& dir);

  const results::RunRecord& run_;
  std::vector<std::vector<PointsStep>> points_;    ///< by UAV
  std::vector<std::optional<MapInTime>> in_time_;  ///< by UAV
};

}  // namespace skein::view
