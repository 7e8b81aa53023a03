// Joins files that several programs have written at the same time: copies their chunks unchanged, in order of time, and
// writes one summary. It uses all complete chunks of a truncated part.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recording/mcap/records.hpp"

namespace skein::mcap {

/// @param parts  ids of schemas and channels must be unique over all parts (WriterOptions::first_id).
/// @param metadata  of the joined file.
/// @returns a message about what went wrong; empty: `file` is complete. The message names each part that is not an MCAP
///   file, which `file` then lacks, and each damaged part (Reader::damage()); after damage, do not rely on `file`.
/// @throws std::system_error if `file` cannot be opened.
std::string join(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& file,
                 const std::vector<Metadata>& metadata);

}  // namespace skein::mcap
