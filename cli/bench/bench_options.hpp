// The options of `skein bench`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein::cli {

struct BenchOptions {
  bool quick = false;
  bool hour = false;                   ///< memory over an hour of simulated time too
  std::vector<std::string> scenarios;  ///< scenarios of the speed runs; empty: towers, and mbs with --assets
  std::optional<std::filesystem::path> assets;
  std::string dds = "cyclonedds";
  std::vector<std::size_t> sizes;  ///< sizes of the fleets; empty: the default ones
  std::optional<int> repeats;
  std::optional<double> duration_s;  ///< mission time of the speed runs, or of the runs of `tracking`
  std::optional<std::filesystem::path> json;
  bool planners = false;                         ///< measure the scores of all planners, not the machine
  bool sensing = false;                          ///< measure only what an explorer's map knows of space
  bool tracking = false;                         ///< measure only how far UAVs are from their setpoints
  bool view = false;                             ///< measure only the cost of a page that follows a run
  bool python = false;                           ///< measure only the cost of planners in Python
  bool profile = false;                          ///< the cost of each stage and planner, by the size of the fleet
  std::optional<std::filesystem::path> against;  ///< the table of scores to compare with; none: the shipped one
  std::optional<std::filesystem::path> write;    ///< file for the new table; with `sensing`, a folder
};

}  // namespace skein::cli
