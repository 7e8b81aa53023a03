// `skein fleet`: a fleet that another program steps, as skein.Fleet does in Python. The launcher plans and checks the
// flight, then replaces itself by the process that simulates the whole fleet (one_process/session.hpp).
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Replaces this process; returns only when that fails. @throws InputError, Interrupted.
int step_fleet(const FleetOptions& options, const Console& console);

}  // namespace skein::cli
