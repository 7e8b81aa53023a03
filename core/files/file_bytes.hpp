// Reads files from untrusted sources, as a whole or line by line. If a path leads to something else than a regular file
// (a pipe without a writer, an endless device), or a line is absurdly long (a file of zeros), these functions throw,
// and neither block nor exhaust the memory. Any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace skein {

/// @param most_bytes  a larger file is rejected before it is read.
/// @throws InputError naming the file when it is missing, a folder, unreadable or too large.
std::string read_file_bytes(const std::filesystem::path& file, std::uintmax_t most_bytes);

/// Opens a file to read it. The stream is bad when there is no such file, or it cannot be read.
/// @throws InputError when the path leads to something else than a regular file.
std::ifstream open_text(const std::filesystem::path& file);

/// As std::getline(), but for lines of at most 1 MiB, which may also end with "\r\n". @param file  for messages.
/// @throws InputError when the line is longer.
bool next_line(std::istream& in, std::string& line, const std::filesystem::path& file);

}  // namespace skein
