// The environment of every program of a fleet: what could change a result is taken out or pinned. The launcher gives it
// to those that it starts; who starts a program by hand, or in a container, need not.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// This process's environment with some variables set. @returns NAME=VALUE strings.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& variables);

/// This process's environment with what could change a result taken out or pinned. Taken out is what would reach
/// into the DDS of the programs (ignored_variables()). Pinned are the C locale, one thread for OpenMP and BLAS,
/// Python's hash seed, and the code that libm, NumPy and OpenBLAS select by CPU (their AVX and FMA variants of sin,
/// exp, pow... differ from the SSE2 ones in last bits).
/// @param native leaves them to choose the fastest code for this CPU.
/// @param more set on top of that, so a program can be given again what was taken out.
std::vector<std::string> fleet_environment(bool native, const std::map<std::string, std::string>& more = {});

/// Whoever has this variable was started with all that.
inline constexpr const char* kPinnedVariable = "SKEIN_PINNED";

/// The number of the run, for programs that are started without --run.
inline constexpr const char* kRunVariable = "SKEIN_RUN";

/// NAME of NAME=VALUE.
std::string_view variable_in(std::string_view entry);

/// What of it is set.
std::map<std::string, std::string> pinned_variables(bool native);

/// Variables of this environment that no program of a fleet gets, by name: settings of DDS vendors and of ROS 2
/// discovery, and what the launcher alone tells a program (SKEIN_DOMAIN...).
std::vector<std::string> ignored_variables();
bool is_ignored_variable(std::string_view name);

/// First thing in main(): libm chooses its code by the environment that a process starts with, so a program that was
/// not given that of a fleet runs itself again with it. SKEIN_RUN is handed on.
void take_fleet_environment(char** argv);

}  // namespace skein
