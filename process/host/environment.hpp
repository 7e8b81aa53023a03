// The environment of all programs of a fleet, without or with fixed values for variables that could change a result.
// The launcher passes it to the programs that it starts. A program that is started by hand, or in a container, sets it
// itself (take_fleet_environment()).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// This process's environment with some variables set. @returns NAME=VALUE strings.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& variables);

/// This process's environment, without or with fixed values for variables that could change a result. It lacks the
/// variables that would configure the programs' DDS (ignored_variables()). It fixes the C locale, one thread for OpenMP
/// and BLAS, Python's hash seed, and the code that libm, NumPy and OpenBLAS select by CPU (the last bits of their AVX
/// and FMA variants of sin, exp, pow... differ from those of the SSE2 variants).
/// @param native  true: libm, NumPy and OpenBLAS may choose the fastest code for this CPU.
/// @param more  variables to set in addition; may contain variables that were removed.
std::vector<std::string> fleet_environment(bool native, const std::map<std::string, std::string>& more = {});

/// A process that has this variable was started with such an environment.
inline constexpr const char* kPinnedVariable = "SKEIN_PINNED";

/// The number of the run, for programs that are started without --run.
inline constexpr const char* kRunVariable = "SKEIN_RUN";

/// NAME of NAME=VALUE.
std::string_view variable_in(std::string_view entry);

/// The variables that fleet_environment() sets.
std::map<std::string, std::string> pinned_variables(bool native);

/// Names of the variables of this process's environment that programs of a fleet do not inherit: settings of DDS
/// vendors and of ROS 2 discovery, and variables that only the launcher may set for a program (SKEIN_DOMAIN...).
std::vector<std::string> ignored_variables();
bool is_ignored_variable(std::string_view name);

/// Call it first in main(). If the process was started without the environment of a fleet, this executes the program
/// again with it, because libm selects its code by the environment at the start of a process. SKEIN_RUN is kept.
void take_fleet_environment(char** argv);

}  // namespace skein
