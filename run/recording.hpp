// Joins the recordings of a run's programs (the parts) into recording.mcap.   Threads: any.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "process/json_text.hpp"
#include "recording/mcap/reader.hpp"

namespace skein::cli {

/// @returns a sentence for each damage of a run's recording or its parts: file, chunk, and what is missing. A part that
/// was cut off, because its program was killed, is not damaged.
std::vector<std::string> recording_damage(const std::filesystem::path& dir);

/// The digest of the recorded run, from the recording's metadata; empty: there is none.
std::string recorded_digest(const mcap::Reader& recording);

/// The parts in a run's folder that are not empty.
std::vector<std::filesystem::path> recording_parts(const std::filesystem::path& dir);

/// Joins the parts in a run's folder into recording.mcap, and removes them.
/// @param result  result.json, for the recording's metadata.
/// @returns an error message, and the parts stay; empty: no error.
std::string join_parts(const std::filesystem::path& dir, const Json& result);

/// Calls join_parts(), then writes rosbag2's metadata.yaml and a layout for Foxglove and related viewers beside the
/// recording. Does nothing if there are no parts.
/// @param result  as for join_parts(). @returns an error message; empty: no error.
std::string join_recording(const std::filesystem::path& dir, const Scenario& scenario, const Json& result);

}  // namespace skein::cli
