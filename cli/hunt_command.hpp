// `skein hunt`: a search for faults that break a property.
#pragma once

#include "cli/console.hpp"
#include "cli/hunt_options.hpp"

namespace skein::cli {

/// `skein hunt`: searches for faults that break a property, and writes a capsule for each find.
/// @returns kExitDone when nothing was found, kExitCheckFailed with finds. @throws InputError, Interrupted.
int run_hunt(const HuntOptions& options, const Console& console);

}  // namespace skein::cli
