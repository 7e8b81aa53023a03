// The environment that the launcher gives to every program of a fleet.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace skein::cli {

/// The launcher's own environment with some variables set. @returns NAME=VALUE strings.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& variables);

/// The launcher's own environment with what could change a result pinned: the C locale, one OpenMP thread, and the
/// code that libm selects by CPU (its AVX and FMA variants of sin, exp, pow... differ from the SSE2 ones in last bits).
/// @param native leaves libm to choose the fastest code for this CPU.
/// @param more set on top of that.
std::vector<std::string> fleet_environment(bool native, const std::map<std::string, std::string>& more = {});

/// @throws InputError when a variable that the programs read means nothing: SKEIN_CHAOS that is no whole number.
void check_environment();

/// The part of it that differs from what a shell would give, as `NAME=VALUE ` words to put before a command.
std::string fleet_environment_prefix(bool native);

}  // namespace skein::cli
