// Where a program is, as a shell finds it.   Threads: any, while nobody changes PATH.
#pragma once

#include <filesystem>
#include <string>

namespace skein {

/// The file of a command: itself when it names a folder, else the first in PATH. Empty: there is no such program.
std::filesystem::path command_file(const std::string& command);

}  // namespace skein
