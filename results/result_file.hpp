// Writes and reads the file result.json. It contains a checksum, which readers verify, so that a damaged file does not
// pass for a run's result.   Threads: any.
#pragma once

#include <filesystem>
#include <string>

#include "process/json_text.hpp"

namespace skein::results {

/// The text of the file, its checksum (process/json_text.hpp) included.
std::string result_text(Json result);

/// Reads the result in a run's folder. Accepts a file without a checksum, since earlier versions wrote none, but checks
/// its keys (result_keys.hpp).
/// @throws InputError if there is no file, it cannot be read, it is not a JSON object, its checksum is wrong, or it has
///   no checksum and a wrong key.
Json read_result_file(const std::filesystem::path& run);

}  // namespace skein::results
