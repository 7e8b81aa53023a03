// Generated worlds (core/scenario/drawn_worlds.hpp): each is generated once, and kept as files in the user's cache.
// Threads: one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/scenario/scenario.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

/// The scenario argument that programs get: for a generated world its file in the cache, which sim_server generates now
/// if it is missing or damaged; any other scenario unchanged.
/// @param uavs  size of the fleet; only the district depends on it.
/// @throws InputError when there is no cache folder, or sim_server reports bad input; std::runtime_error when it fails
///   otherwise; Interrupted.
std::string scenario_source(const std::string& scenario, const std::optional<std::uint64_t>& scene_seed,
                            const std::optional<std::size_t>& uavs = {});

/// The scenario that a run flies. Generated worlds have no file under their name, so do not give a run's scenario to
/// load_scenario(). @throws what scenario_source() and load_scenario() throw.
Scenario scenario_flown(const RunOptions& options, bool needs_scene_files = true);

}  // namespace skein::cli
