// Selects the program at the ground station.   Threads: one.
#pragma once

#include <filesystem>
#include <optional>

#include "run/planner_spec.hpp"

namespace skein::cli {

/// The program that the user named for `gcs`. If they named none: the planner that flies the UAVs for which they named
/// none, if its agent program lists it as one with a program at the ground station.
/// @param agent  the fleet's agent program, unless the planner names another one.
/// @returns a strategy, with its parameters if any, or "exec:CMD"; nullopt: nothing runs there ("gcs=none" too).
std::optional<UavPlanner> ground_program(const Planners& planners, const std::filesystem::path& agent);

}  // namespace skein::cli
