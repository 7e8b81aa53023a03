// `skein check-planner`: flies the same missions in changed process surroundings (memory layout, clock, load, ...),
// which must not change the result, and reports those that do.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @returns kExitDone when all runs are the same, kExitCheckFailed when one differs. @throws InputError, Interrupted.
int check_planner(const CheckPlannerOptions& options, const Console& console);

}  // namespace skein::cli
