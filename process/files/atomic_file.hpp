// Files that appear whole or not at all. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skein {

/// Which users may read a file that root writes (closed_to_agents.hpp).
enum class Readers { all, no_agents };

/// Writes a temporary file beside `path`, brings it to the disk and renames it: a reader sees the old content or the
/// new, also after a crash. The folder must exist.
/// @throws std::runtime_error with the system's reason; no temporary file is left.
void write_file_atomically(const std::filesystem::path& path, std::string_view content, Readers readers = Readers::all);

/// The same, for a file that the program can do without; one in kNowhere (process/files/nowhere.hpp) is not written.
/// @returns what went wrong, with the file's name, for people; empty when it is written.
std::string write_if_possible(const std::filesystem::path& path, std::string_view content);

}  // namespace skein
