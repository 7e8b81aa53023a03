// A run's options as JSON for the process that flies it, and as words of a command line for people.
#pragma once

#include <string>
#include <vector>

#include "run/run_options.hpp"

namespace skein::cli {

/// The inverse of parse_command_line(), for people: the arguments of `skein` that repeat this run.
std::vector<std::string> arguments_of(const RunOptions& run);

/// First argument of the `skein` process that flies a run for another one.
inline constexpr const char* kFlight = "--flight";
/// The network if no option names one.
inline constexpr const char* kNetworkVariable = "SKEIN_NETWORK";

/// The arguments of `skein` that fly this run in a process of its own: kFlight, and the options as JSON.
/// @throws InputError if a path or another text is not in UTF-8.
std::vector<std::string> flight_words(const RunOptions& run);
/// The options that flight_words() has written as JSON, with the command line that repeats the run as `command`.
/// @throws InputError for text that is no such JSON: an unknown option, or a value of another kind. The values are not
///   checked; parse_command_line() does that with arguments_of().
RunOptions flight_of(const std::string& json);

}  // namespace skein::cli
