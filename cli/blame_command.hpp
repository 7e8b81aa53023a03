// `skein blame`: flies a run again without one of its faults at a time, and on request without one link's messages at
// a time, and ranks them by what they cost.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @returns the exit code. @throws InputError when there is nothing to blame, or the run cannot be repeated;
///   Interrupted.
int blame(const BlameOptions& options, const Console& console);

}  // namespace skein::cli
