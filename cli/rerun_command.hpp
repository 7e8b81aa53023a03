// `skein rerun` and `skein fork`, and what they read of a finished run, for other commands that fly it again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "process/json_text.hpp"
#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Options that `skein rerun` and `skein fork` share.
struct Reflight {
  std::filesystem::path run;                   ///< results folder of the recorded run
  std::optional<std::filesystem::path> agent;  ///< as in RunOptions
  std::optional<std::string> dds;              ///< a vendor or "mixed"; none: in one process where possible
  std::vector<std::string> debug;              ///< as in RunOptions
  std::optional<std::filesystem::path> out;    ///< none: a new folder in `run`
  bool force = false;                          ///< overwrite an existing result
};

struct RerunOptions {
  Reflight reflight;
  std::string uav;
  std::optional<std::string> planner;  ///< instead of the planner that flew
};

struct ForkOptions {
  Reflight reflight;
  double at_s = 0.0;
  std::optional<std::string> planner;  ///< "UAV=NAME,..."
};

/// Adds the command `rerun`, whose options CLI11 parses into the second argument.
void add_rerun(CLI::App& app, RerunOptions& rerun);

/// Adds the command `fork`, whose options CLI11 parses into the second argument.
void add_fork(CLI::App& app, ForkOptions& fork);

/// `skein rerun`: replays a recorded run to one UAV's software, without the rest of the fleet's software.
/// @returns 0 when the software sends the same messages as then and the digest is the same, 1 when not; else the code
///   of the flight. @throws InputError when the run has no whole recording, or cannot be repeated.
int rerun(const RerunOptions& options, const Console& console);

/// `skein fork`: replays a recorded run up to some time, then lets it continue differently. @returns as the flight
/// does.
/// @throws InputError as rerun(), and when the recorded run ended before options.at_s.
int fork_run(const ForkOptions& options, const Console& console);

/// The names of the UAVs in a result.json, in its order.
std::vector<std::string> fleet_of(const Json& result);

/// The options of the run in a results folder, as the user gave them then, without those that only that run needed
/// (output, debugging, view, security). @throws InputError when the folder does not record them.
RunOptions options_of_run(const std::filesystem::path& run);

/// Outcome of replaying a run to the software of its UAVs.
struct ThoughtAgain {
  int code = 0;                        ///< exit code of the flight; `different` is valid when it is 0
  std::vector<std::string> different;  ///< differences of messages or world from the recorded run; empty: none
};

/// Replays the run to the UAVs' agents, which write snapshots of their maps to `out`, a folder that is overwritten.
/// @throws InputError when the run has no whole recording, cannot be repeated, or none of its UAVs keeps maps.
ThoughtAgain think_again_with_maps(const std::filesystem::path& run, const std::filesystem::path& out,
                                   const Console& console);

}  // namespace skein::cli
