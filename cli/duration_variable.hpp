// SKEIN_DURATION, the environment variable with the mission's duration.
#pragma once

#include <string>
#include <vector>

namespace skein::cli {

/// Mission duration [s] of `skein run`, `compose`, `compare` and `contest` without --duration.
inline constexpr const char* kDurationVariable = "SKEIN_DURATION";

/// Adds `--duration` with the value of kDurationVariable to the arguments of one of these commands, if they have no
/// --duration. So the command that a result records repeats the run without the variable.
/// @throws InputError if the variable is needed and not a valid duration.
std::vector<std::string> with_duration_of_environment(std::vector<std::string> arguments);

}  // namespace skein::cli
