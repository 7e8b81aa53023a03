// The launcher's own environment: what its user should know of it. What it gives to programs: process/environment.hpp.
#pragma once

#include <string>
#include <vector>

#include "process/environment.hpp"

namespace skein::cli {

/// What the user should know of his environment: what is ignored, and names like SKEIN_CHOAS that nobody reads.
std::vector<std::string> environment_warnings();

/// @throws InputError when a variable that the programs read means nothing: SKEIN_CHAOS that is no whole number.
void check_environment();

/// The part of it that differs from what a shell would give, as words to put before a command: `NAME=VALUE `, after
/// `env -u NAME ` for what is to be ignored.
std::string fleet_environment_prefix(bool native);

/// Of the launcher itself, before it opens anything: descriptors 0 to 2 are open, what it makes is its user's to use
/// whatever the umask, and the ends of children are told whatever was inherited.
void settle_process();

}  // namespace skein::cli
