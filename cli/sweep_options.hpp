// The options with which an engine flies a study or a hunt on several processes or machines (cli/sweep/), and those of
// the unit that an engine starts. Pure; any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace skein::cli {

/// Which engine flies a study or a hunt when this process does not fly it alone: cli/sweep/.
struct SweepOptions {
  std::optional<std::string> executor;  ///< local, parallel or slurm; none: flights are children of this process
  std::vector<std::string> logins;      ///< for `parallel`: hosts, as ssh accepts them
  std::optional<std::string> slurm;     ///< options of sbatch, as sbatch_options() reads them
  bool detach = false;                  ///< submit the jobs to Slurm and exit
  double unit_minutes = 5.0;            ///< approximate wall time of a unit's flights
  std::optional<std::filesystem::path> status;  ///< do not fly: print the status of the study in this folder
  std::vector<std::string> command;             ///< arguments of `skein`, as typed
};

/// `skein --unit`: an engine runs this on a node, to fly one unit of a sweep.
struct UnitOptions {
  std::filesystem::path study;
  std::size_t unit = 0;
};

/// Adds the options for flying a study or a hunt beyond one process.
void add_sweep(CLI::App& command, SweepOptions& sweep);
/// The same, with --detach and --status. A hunt has neither: after each round it decides what flies next.
void add_sweep_of_study(CLI::App& command, SweepOptions& sweep);
/// @throws InputError for options that need another --executor.
void check_sweep(const SweepOptions& sweep);
/// Parses `skein --unit STUDY N`, which engines call, not users. @throws InputError
UnitOptions unit_options(const std::vector<std::string>& words);

}  // namespace skein::cli
