// The command line of `skein`, read into plain structs. Nothing is opened or started here.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/command_line.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// @param arguments without the program's name. @throws InputError for anything that does not fit.
Command parse_command_line(const std::vector<std::string>& arguments);

/// Calls `use` with all commands and their options, before anything is parsed: for help texts and completion.
void with_command_line(const std::function<void(const CLI::App&)>& use);

/// The inverse of parse_command_line(), for people: the arguments of `skein` that repeat this run.
std::vector<std::string> arguments_of(const RunOptions& run);

/// First argument of the `skein` process that flies a run for another one.
inline constexpr const char* kFlight = "--flight";
/// The network if no option names one.
inline constexpr const char* kNetworkVariable = "SKEIN_NETWORK";

/// The arguments of `skein` that fly this run in a process of its own: kFlight, and the options as JSON.
std::vector<std::string> flight_words(const RunOptions& run);
/// The options that flight_words() has written as JSON, with the command line that repeats the run as `command`.
RunOptions flight_of(const std::string& json);

}  // namespace skein::cli
