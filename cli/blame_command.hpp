// skein blame: takes each fault of a run away, and each link's messages if that is wanted, flies again, and ranks them
// by what they cost.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @throws InputError when there is nothing to blame, or the run cannot be repeated; Interrupted.
int blame(const BlameOptions& options, const Console& console);

}  // namespace skein::cli
