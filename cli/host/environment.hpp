// The launcher's own environment: what its user should know of it. What it gives to programs:
// process/host/environment.hpp.
#pragma once

#include <string>
#include <vector>

#include "process/host/environment.hpp"

namespace skein::cli {

/// What the user should know of his environment: what is ignored, and names like SKEIN_CHOAS that nobody reads.
std::vector<std::string> environment_warnings();

/// @throws InputError when a variable that the programs read means nothing: SKEIN_CHAOS that is no whole number.
void check_environment();

/// Length of the missions of commands that name none.
inline constexpr const char* kDurationVariable = "SKEIN_DURATION";

/// A command line as its user would have typed it without that variable: with `--duration` where the command flies and
/// has none, so that a run is repeated by what it says of itself.
/// @throws InputError when the variable is no time.
std::vector<std::string> with_duration_of_environment(std::vector<std::string> arguments);

/// The part of it that differs from what a shell would give, as words to put before a command: `NAME=VALUE `, after
/// `env -u NAME ` for what is to be ignored.
std::string fleet_environment_prefix(bool native);

/// Of the launcher itself, before it opens anything: descriptors 0 to 2 are open, what it makes is its user's to use
/// whatever the umask, and the ends of children are told whatever was inherited.
void settle_process();

}  // namespace skein::cli
