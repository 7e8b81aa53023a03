// Slurm: units as a job array, and a job behind it that merges. docs: sbatch(1), squeue(1).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/sweep/engine.hpp"
#include "cli/sweep/folder.hpp"

namespace skein::cli {

/// Whether the shell would find it.
bool is_installed(const std::string& program);

/// @throws InputError when there is no Slurm.
std::unique_ptr<SweepEngine> make_slurm_engine(const SweepOptions& options, std::optional<int> jobs,
                                               const SweepFolder& folder, const Console& console);

/// Set where the job behind an array goes on with the sweep: it does not give what failed all its tries again.
inline constexpr const char* kMergeVariable = "SKEIN_SWEEP_MERGES";

}  // namespace skein::cli
