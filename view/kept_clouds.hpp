// Points and maps of a run that is over, as far as its results folder has them: the map that each UAV left behind, and
// LiDAR points where the recording has clouds (--record=clouds).
// Frame W.   Threads: one.   Bounded: kMostPointsKept points a UAV.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "report/run_data.hpp"
#include "view/feed.hpp"
#include "view/scan_points.hpp"
#include "view/story.hpp"

namespace skein::view {

class KeptClouds {
 public:
  static constexpr std::size_t kMostPointsKept = 30'000;

  /// Reads what there is; what is damaged counts as missing. @param run  of this folder; must outlive this.
  KeptClouds(const std::filesystem::path& dir, const report::RunData& run);

  /// Tells all of it. @param last  the fleet at its end: free space is shown at its heights.
  void tell(std::span<const ShownUav> last, Feed& feed) const;

  std::vector<std::string> lidar = {};  ///< UAVs of which there are points
  std::vector<std::string> maps = {};   ///< UAVs of which there is a map
  std::string missing = {};             ///< what there is not, and how a run gets it, for people; empty: nothing

 private:
  void read_recording(const std::filesystem::path& file);

  const report::RunData& run_;
  std::vector<std::vector<PointsStep>> points_;  ///< by UAV
};

}  // namespace skein::view
