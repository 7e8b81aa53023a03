// The options of `skein bench`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein::cli {

struct BenchOptions {
  bool quick = false;                            ///< shorter and fewer runs
  bool hour = false;                             ///< measure also how memory grows over an hour of simulated time
  std::vector<std::string> scenarios;            ///< scenarios of the speed runs; empty: towers, and mbs with --assets
  std::optional<std::filesystem::path> assets;   ///< folder of CARIC's data
  std::string dds = "cyclonedds";                ///< DDS vendor
  std::vector<std::size_t> sizes;                ///< sizes of the fleets; empty: the default ones
  std::optional<int> repeats;                    ///< number of runs of each kind; nullopt: the default
  std::optional<double> duration_s;              ///< mission time of the speed runs, or of tracking, view or python
  std::optional<std::filesystem::path> json;     ///< file for all figures
  bool planners = false;                         ///< measure the scores of all planners, not the machine
  bool sensing = false;                          ///< measure only what an explorer's map knows of space
  bool tracking = false;                         ///< measure only how far UAVs are from their setpoints
  bool view = false;                             ///< measure only the cost of a page that follows a run
  bool python = false;                           ///< measure only the cost of planners in Python
  bool profile = false;                          ///< measure only the cost of each stage and planner, by fleet size
  std::optional<std::filesystem::path> against;  ///< table of scores; nullopt: config/planner_scores.csv
  std::optional<std::filesystem::path> write;    ///< file for the new table; with `sensing`, a folder
};

}  // namespace skein::cli
