// skein rerun: one UAV's software thinks again what it thought in a recorded run, without the fleet.
// skein fork: a recorded run goes on differently from some time on.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// What was flown in a results folder, as the user gave it then, less what belonged to that run alone.
/// @throws InputError when the folder does not tell.
RunOptions options_of_run(const std::filesystem::path& run);

/// @returns the exit code: 0 when the software says what it said then, 1 when it does not.
/// @throws InputError when the run has no whole recording, or cannot be repeated.
int rerun(const RerunOptions& options, const Console& console);

/// @returns the exit code of the run.
int fork_run(const ForkOptions& options, const Console& console);

}  // namespace skein::cli
