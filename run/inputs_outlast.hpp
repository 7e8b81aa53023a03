// A run with --force first deletes an earlier run's files from its results folder. Files that the run itself reads must
// not be among them: the recording of a fork, the faults by hand of an earlier run, its copies of planners. Any thread.
#pragma once

#include <filesystem>
#include <vector>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// The files that a run reads from the places in its plan: scenario, vehicles, scene, faults, planners and their
/// parameters, commands by hand, agent programs, --network, --place and the recording of a rerun. Some need not exist.
std::vector<std::filesystem::path> input_files(const FleetPlan& plan);

/// @param dir  the results folder; need not exist.
/// @throws InputError if a run in `dir` would delete one of these files: the file itself, or a link that leads to it.
void check_outlast(const std::vector<std::filesystem::path>& files, const std::filesystem::path& dir);

/// check_outlast() for all input_files().
void check_inputs_outlast(const FleetPlan& plan, const std::filesystem::path& dir);

}  // namespace skein::cli
