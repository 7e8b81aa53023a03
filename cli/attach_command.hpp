// `skein ps` and `skein attach`: fleets that are already flying.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// A table of the user's running fleets. @returns kExitDone
int list_fleets(const Console& console);

/// Replaces this process by the debugging tool, attached to one program of a flying fleet; returns only on failure.
/// @throws InputError when there is no such fleet or program, more than one, or no such tool
int attach_to(const AttachOptions& options, const Console& console);

}  // namespace skein::cli
