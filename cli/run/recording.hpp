// recording.mcap of what the programs of a run have recorded, each for itself.
#pragma once

#include <filesystem>
#include <string>

#include "core/scenario.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// Joins the parts in a run's folder, and removes them. Without parts it does nothing. Beside the recording it puts a
/// layout for viewers of Foxglove's family.
/// @param result  what the recording says of its run.
/// @returns what went wrong, for people; empty: nothing. The parts stay then.
std::string join_recording(const std::filesystem::path& dir, const Scenario& scenario, const Json& result);

}  // namespace skein::cli
