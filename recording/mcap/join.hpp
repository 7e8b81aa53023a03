// Several files, written at the same time by several programs, become one: their chunks are copied as they are, in the
// order of time, and get one summary. A part that is cut off counts as far as it goes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recording/mcap/records.hpp"

namespace skein::mcap {

/// @param parts  their schemas and channels have different ids (WriterOptions::first_id).
/// @param metadata  of the whole.
/// @returns what went wrong, for people; empty: `file` is whole. A part that is no MCAP file is left out and reported,
/// and so is what is damaged of a part (Reader::damage): `file` is then no recording to go by.
/// @throws std::system_error when `file` cannot be opened.
std::string join(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& file,
                 const std::vector<Metadata>& metadata);

}  // namespace skein::mcap
