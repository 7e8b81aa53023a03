// `skein hunt`: searches for faults that break a property, and writes a capsule for each find.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @returns kExitDone when nothing was found, kExitCheckFailed with finds. @throws InputError, Interrupted.
int run_hunt(const HuntOptions& options, const Console& console);

}  // namespace skein::cli
