// skein replay: a finished run on the page that follows a run that flies, or two on one clock; served, or as a file.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Serves the page until the user interrupts, or writes the file.
/// @throws InputError when a folder holds no result, two runs have no scene in common, no page can be served, or the
///   file cannot be written as it was asked for; Interrupted while a film is made.
int replay_run(const ReplayOptions& options, const Console& console);

}  // namespace skein::cli
