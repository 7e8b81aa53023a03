// skein rerun: one UAV's software thinks again what it thought in a recorded run, without the fleet.
// skein fork: a recorded run goes on differently from some time on.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// The UAVs of a result.json, by name.
std::vector<std::string> fleet_of(const Json& result);

/// What was flown in a results folder, as the user gave it then, less what belonged to that run alone.
/// @throws InputError when the folder does not tell.
RunOptions options_of_run(const std::filesystem::path& run);

/// What came of flying a run again with all software of its UAVs.
struct ThoughtAgain {
  int code = 0;                        ///< exit code of the flight; the rest is there when it is 0
  std::vector<std::string> different;  ///< what the software says otherwise than then, or the world; empty: nothing
};

/// The UAVs' software thinks again what it thought, and keeps its maps in time in `out`, a folder that is overwritten.
/// @throws InputError when the run has no whole recording, cannot be repeated, or no UAV of it keeps maps.
ThoughtAgain think_again_with_maps(const std::filesystem::path& run, const std::filesystem::path& out,
                                   const Console& console);

/// @returns the exit code: 0 when the software says what it said then, 1 when it does not.
/// @throws InputError when the run has no whole recording, or cannot be repeated.
int rerun(const RerunOptions& options, const Console& console);

/// @returns the exit code of the run.
int fork_run(const ForkOptions& options, const Console& console);

}  // namespace skein::cli
