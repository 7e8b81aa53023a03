// Joins files that several programs have written at the same time: copies their chunks unchanged, in order of time, and
// writes one summary. Of a truncated part, all complete chunks are used.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recording/mcap/records.hpp"

namespace skein::mcap {

/// @param parts  ids of schemas and channels must be unique over all parts (WriterOptions::first_id).
/// @param metadata  of the joined file.
/// @returns what went wrong, for people; empty: `file` is complete. A part that is not an MCAP file is left out and
///   reported. Damage of a part (Reader::damage()) is reported, too; `file` is then not reliable.
/// @throws std::system_error if `file` cannot be opened.
std::string join(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& file,
                 const std::vector<Metadata>& metadata);

}  // namespace skein::mcap
