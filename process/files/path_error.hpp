// Errors of the file system, as messages for users.   Pure.
#pragma once

#include <filesystem>
#include <string>

namespace skein {

/// "runs/x: File name too long".
std::string path_error_text(const std::filesystem::filesystem_error& error);

/// Whether the path itself is the mistake (it is too long, links form a circle, the user may not look there), so that
/// another path would do. False for a full or broken disk.
bool is_wrong_path(const std::filesystem::filesystem_error& error);

}  // namespace skein
