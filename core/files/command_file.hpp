// Finds a program's file as a shell does.   Threads: any, while no thread changes PATH.
#pragma once

#include <filesystem>
#include <string>

namespace skein {

/// The file of a command: the command itself if it contains a '/', else the first match in PATH. Empty: none found.
std::filesystem::path command_file(const std::string& command);

}  // namespace skein
