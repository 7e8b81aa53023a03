// `skein replay`: shows a finished run, or two runs on one clock, on the same page that follows a live run. The page is
// served, or written to a file.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Serves the page until the user interrupts, or writes the file. @returns the exit code.
/// @throws InputError when a folder holds no result, two runs have no scene in common, no page can be served, or the
///   requested file cannot be written; Interrupted while a film is made.
int replay_run(const ReplayOptions& options, const Console& console);

}  // namespace skein::cli
