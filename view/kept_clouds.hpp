// Points and maps of a run that is over, as far as its results folder has them: each UAV's map in time (map_files.hpp),
// else the one that it left behind, and LiDAR points where the recording has clouds (--record=clouds).
// Frame W.   Threads: one.   Bounded: kMostPointsKept points a UAV.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/run_data.hpp"
#include "view/feed.hpp"
#include "view/map_steps.hpp"
#include "view/scan_points.hpp"
#include "view/story.hpp"

namespace skein::view {

/// By UAV: its height by time.
using Heights = std::vector<std::map<double, double>>;

class KeptClouds {
 public:
  static constexpr std::size_t kMostPointsKept = 30'000;

  /// Reads what there is; what is damaged counts as missing. @param run  of this folder; must outlive this.
  /// @param heights  of the whole run: free space in time is shown there.
  KeptClouds(const std::filesystem::path& dir, const results::RunData& run, const Heights& heights = {});

  /// Tells all of it. @param last  the fleet at its end: free space is shown at its heights.
  void tell(std::span<const ShownUav> last, Feed& feed) const;

  std::vector<std::string> lidar = {};  ///< UAVs of which there are points
  std::vector<std::string> maps = {};   ///< UAVs of which there is a map
  std::string missing = {};             ///< what there is not, and how a run gets it, for people; empty: nothing

 private:
  void read_recording(const std::filesystem::path& file);
  void say_what_is_missing(const std::filesystem::path& dir);

  const results::RunData& run_;
  std::vector<std::vector<PointsStep>> points_;    ///< by UAV
  std::vector<std::optional<MapInTime>> in_time_;  ///< by UAV
};

}  // namespace skein::view
