// `skein ps` and `skein attach`: fleets that are already flying.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// A table of the user's running fleets. @returns kExitDone
int list_fleets(const Console& console);

/// Becomes the tool, attached to the process of a program: does not return unless that fails.
/// @throws InputError when there is no such fleet or program, more than one, or no such tool
int attach_to(const AttachOptions& options, const Console& console);

}  // namespace skein::cli
