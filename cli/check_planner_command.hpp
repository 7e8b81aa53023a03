// `skein check-planner`.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/console.hpp"
#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein check-planner`: whether a planner's runs stay the same when the surroundings of its process change.
struct CheckPlannerOptions {
  RunOptions run;
  std::optional<std::filesystem::path> out;  ///< folder in which the flights are kept
  bool force = false;                        ///< write to a folder that is not empty
};

/// Adds the command `check-planner`, whose options CLI11 parses into the second argument.
void add_check_planner(CLI::App& app, CheckPlannerOptions& check);

/// `skein check-planner`: flies the same missions in changed process surroundings (memory layout, clock, load, ...),
/// which must not change the result, and reports those that do.
/// @returns kExitDone when all runs are the same, kExitCheckFailed when one differs. @throws InputError, Interrupted.
int check_planner(const CheckPlannerOptions& options, const Console& console);

}  // namespace skein::cli
