// A whole file in memory. Any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace skein {

/// @param most_bytes a larger file is refused before it is read.
/// @throws InputError naming the file when it is missing, a folder, unreadable or too large.
std::string read_file_bytes(const std::filesystem::path& file, std::uintmax_t most_bytes);

}  // namespace skein
