// Checks of the launcher's own environment variables. For the environment that the launcher gives to its programs, see
// process/host/environment.hpp.   Threads: the launcher's one.
#pragma once

#include <string>
#include <vector>

#include "process/host/environment.hpp"

namespace skein::cli {

/// @returns warnings for the user: variables that programs do not inherit, and unknown names such as SKEIN_CHOAS.
std::vector<std::string> environment_warnings();

/// @throws InputError if SKEIN_CHAOS, which the programs read, is set and not a whole number.
void check_environment();

/// A prefix for a command that the user types in a shell, to give a program the environment of a fleet: `env -u NAME `
/// for variables that it must not inherit, then `NAME=VALUE ` for those that the launcher would set.
std::string fleet_environment_prefix(bool native);

/// Puts the launcher process into a defined state; call it before opening files. Opens closed descriptors 0 to 2 on
/// /dev/null, removes the owner's bits from the umask, and restores SIGCHLD's default, so that children can be awaited.
void settle_process();

}  // namespace skein::cli
