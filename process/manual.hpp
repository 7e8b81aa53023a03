// A program's manual page, of the same options as its --help: all is said once, where an option is added.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace skein {

/// @param app   with all its options and commands; its description may begin with "NAME: ".
/// @param name  of the program.
/// @returns the source of its page in section 1, for man(1).
std::string manual_of(const CLI::App& app, const std::string& name);

}  // namespace skein
