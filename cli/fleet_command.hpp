// skein fleet: a fleet that a program steps, as skein.Fleet does in Python. The launcher finds out what is to fly and
// whether it can, and becomes the process in which it does (one_process/session.hpp).
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Does not return if the fleet can be stepped. @throws InputError, Interrupted.
int step_fleet(const FleetOptions& options, const Console& console);

}  // namespace skein::cli
