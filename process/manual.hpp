// Generates a program's manual page from the same option descriptions as its --help.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace skein {

/// @param app   the program's options and commands; its description may begin with "NAME: ".
/// @param name  name of the program.
/// @returns source text of its manual page in section 1, for man(1).
std::string manual_of(const CLI::App& app, const std::string& name);

}  // namespace skein
