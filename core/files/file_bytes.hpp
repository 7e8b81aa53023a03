// Files that others wrote: a whole one in memory, or line by line. Whatever bears the name, a pipe that nobody writes
// to, a device without an end, a file of zeros, is told from a text, and neither keeps us nor takes our memory.
// Any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace skein {

/// @param most_bytes a larger file is refused before it is read.
/// @throws InputError naming the file when it is missing, a folder, unreadable or too large.
std::string read_file_bytes(const std::filesystem::path& file, std::uintmax_t most_bytes);

/// Opens a file to read it. The stream is bad when there is no such file, or it cannot be read.
/// @throws InputError when it is something else than a file.
std::ifstream open_text(const std::filesystem::path& file);

/// As std::getline(), for a line of a sensible length. @param file  for messages.
/// @throws InputError when the line is so long that this is no text.
bool next_line(std::istream& in, std::string& line, const std::filesystem::path& file);

}  // namespace skein
