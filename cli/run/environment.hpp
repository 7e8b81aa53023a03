// The environment that the launcher gives to every program of a fleet.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace skein::cli {

/// The launcher's own environment with some variables set. @returns NAME=VALUE strings.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& variables);

/// The launcher's own environment with what could change a result taken out or pinned. Taken out is what would reach
/// into the DDS of the programs (ignored_variables()). Pinned are the C locale, one OpenMP thread, and the code that
/// libm selects by CPU (its AVX and FMA variants of sin, exp, pow... differ from the SSE2 ones in last bits).
/// @param native leaves libm to choose the fastest code for this CPU.
/// @param more set on top of that, so a program can be given again what was taken out.
std::vector<std::string> fleet_environment(bool native, const std::map<std::string, std::string>& more = {});

/// Variables of the launcher's environment that no program of a fleet gets, by name: settings of DDS vendors and of ROS
/// 2 discovery, and what the launcher alone tells a program (SKEIN_DOMAIN...).
std::vector<std::string> ignored_variables();

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
