// `skein diff`.
#pragma once

#include <filesystem>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

struct DiffOptions {
  std::filesystem::path run_a, run_b;
};

/// Adds the command `diff`, whose options CLI11 parses into the second argument.
void add_diff(CLI::App& app, DiffOptions& diff);

/// `skein diff`: when two runs start to differ, and in what. Compares the digests step by step, the results, and the
/// tables of captures, events, scores and trajectories; if the digests differ and both runs have recordings, also the
/// radio messages and commands.
/// A recording that only one run has is a difference, unless the other run was told to record nothing.
/// @returns 0 the same, 1 different. @throws InputError when a folder holds no run, or one of its files is damaged.
int diff_runs(const DiffOptions& options, const Console& console);

}  // namespace skein::cli
