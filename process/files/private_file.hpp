// Writes files that no other user may read, such as keys. Any thread.
#pragma once

#include <filesystem>
#include <string_view>

namespace skein {

/// Creates a file of mode 0600. Removes a former file of this name first, and follows no link.
/// @throws std::system_error with the system's reason; no part of the file is left.
void write_private_file(const std::filesystem::path& file, std::string_view text);

}  // namespace skein
