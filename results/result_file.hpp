// result.json as a file: what the launcher writes carries a checksum, and whoever reads it later holds it against that,
// so that a damaged result does not pass for a run's.   Threads: any.
#pragma once

#include <filesystem>
#include <string>

#include "process/json_text.hpp"

namespace skein::results {

/// The key of the checksum: SHA-256 over all other keys, in their order, however the file is laid out.
inline constexpr const char* kResultChecksum = "checksum";

/// The text of the file, its checksum included.
std::string result_text(Json result);

/// The result in a run's folder. Without a checksum, as of earlier versions, it counts as it is.
/// @throws InputError when there is none, it is no JSON object, or its checksum is wrong.
Json read_result_file(const std::filesystem::path& run);

}  // namespace skein::results
