// `skein diff`: when two runs start to differ, and in what.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Compares the digests step by step, the radio messages and commands (if both runs have recordings), the results, and
/// the tables of captures, events, scores and trajectories.
/// @returns the exit code: 0 the same, 1 different. @throws InputError when a folder holds no run, or one of its files
///   is damaged.
int diff_runs(const DiffOptions& options, const Console& console);

}  // namespace skein::cli
