// What runs at the ground station.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/planner_spec.hpp"

namespace skein::cli {

/// What the user named for `gcs`; where they named nothing, the strategy that flies the UAVs which they did not name
/// either, if it has a program at the ground station. The agent that flies it is asked which have.
/// @param agent  the program that flies them where they name no other.
/// @returns a strategy, with its parameters if any, or "exec:CMD"; nullopt: nothing runs there ("gcs=none" too).
std::optional<UavPlanner> ground_program(const Planners& planners, const std::filesystem::path& agent);

}  // namespace skein::cli
