// The table of all commands of `skein`. A new command gets one line in command_table.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/command_line.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Checks the options of a parsed command, adds defaults, and returns what to execute.
/// @param arguments  the whole command line
/// @throws InputError for options that do not go together.
using TakeCommand = std::function<Command(const std::vector<std::string>& arguments)>;

struct CommandEntry {
  std::string task;  ///< heading of the command in `skein --help`
  /// Adds the command with its options to the command line.
  /// @returns a function to call after the command has been parsed. It owns the options that CLI11 parses into, so it
  ///   must outlive the parsing.
  std::function<TakeCommand(CLI::App&)> add;
};

/// All commands by task, in the order of `skein --help`.
const std::vector<CommandEntry>& command_table();

}  // namespace skein::cli
