// skein check-planner: flies the same missions in other surroundings, which must not make a difference, and says where
// they do.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @returns 0 when all runs are the same, 1 when one is not. @throws InputError, Interrupted.
int check_planner(const CheckPlannerOptions& options, const Console& console);

}  // namespace skein::cli
