// The command line of `skein`, read into plain structs. Nothing is opened or started here.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/command_line.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// @param arguments without the program's name. @throws InputError for anything that does not fit.
Command parse_command_line(const std::vector<std::string>& arguments);

/// Calls `use` with all commands and their options, before anything is parsed: for help texts and completion.
void with_command_line(const std::function<void(const CLI::App&)>& use);

}  // namespace skein::cli
