// recording.mcap of what the programs of a run have recorded, each for itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scenario.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// What of a run's recording, or of its parts, is damaged: which file and chunk, and what is missing. A sentence each;
/// a part that is cut off is not damaged.
std::vector<std::string> recording_damage(const std::filesystem::path& dir);

/// The parts that programs left in a run's folder.
std::vector<std::filesystem::path> recording_parts(const std::filesystem::path& dir);

/// Joins the parts in a run's folder to recording.mcap, and removes them.
/// @param result  what the recording says of its run. @returns as join_recording().
std::string join_parts(const std::filesystem::path& dir, const Json& result);

/// Joins the parts in a run's folder, and removes them. Without parts it does nothing. Beside the recording it puts a
/// layout for viewers of Foxglove's family.
/// @param result  what the recording says of its run.
/// @returns what went wrong, for people; empty: nothing. The parts stay then.
std::string join_recording(const std::filesystem::path& dir, const Scenario& scenario, const Json& result);

}  // namespace skein::cli
