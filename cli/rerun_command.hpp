// What `skein rerun` and `skein fork` read of a finished run, for other commands that fly it again.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

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
