// The engine for Slurm: submits units as a job array, then a job that continues the sweep after the array, and at the
// end merges it. Source: sbatch(1), squeue(1).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cli/console.hpp"
#include "cli/sweep/engine.hpp"
#include "cli/sweep/folder.hpp"
#include "cli/sweep_options.hpp"

namespace skein::cli {

/// Whether PATH has such a program.
bool is_installed(const std::string& program);

/// @throws InputError if Slurm's commands are not installed, or an option for sbatch is not valid.
std::unique_ptr<SweepEngine> make_slurm_engine(const SweepOptions& options, std::optional<int> jobs,
                                               const SweepFolder& folder, const Console& console);

/// Environment variable of the job that runs after an array: it continues the sweep without new tries for failed units.
inline constexpr const char* kMergeVariable = "SKEIN_SWEEP_MERGES";

}  // namespace skein::cli
