// `skein bench`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"

namespace CLI {
class App;
}

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
  bool tracking = false;                         ///< measure only how far UAVs are from their set-points
  bool view = false;                             ///< measure only the cost of a page that follows a run
  bool python = false;                           ///< measure only the cost of planners in Python
  bool profile = false;                          ///< the cost of each stage and planner, by the size of the fleet
  std::optional<std::filesystem::path> against;  ///< the table of scores to compare with; none: the shipped one
  std::optional<std::filesystem::path> write;    ///< file for the new table; with `sensing`, a folder
};

/// Adds the command `bench`, whose options CLI11 parses into the second argument.
void add_bench(CLI::App& app, BenchOptions& bench);

/// `skein bench`: flies and measures speed, memory, and where the time goes, with the same programs that a user's run
/// starts; prints the tables and writes --json. Takes minutes, with --quick well below one. docs/performance.md
/// explains the figures. @returns kExitDone when every run reached its end, whether or not it meets the targets; else
///   kExitProcessFailed, or kExitInterrupted. @throws InputError before anything has started.
int run_bench(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
