// skein hunt: searches for faults that break a property, and makes a capsule of each find.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @returns 0 when nothing was found, 1 with finds. @throws InputError, Interrupted.
int run_hunt(const HuntOptions& options, const Console& console);

}  // namespace skein::cli
