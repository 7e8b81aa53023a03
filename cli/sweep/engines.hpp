// The engines of `--executor`: this machine's cores, GNU parallel over ssh, Slurm. For each unit, an engine runs the
// sweep's script `fly` with the unit's number. Threads: one, which must live as long as the processes that they start.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/sweep/engine.hpp"
#include "cli/sweep/folder.hpp"
#include "cli/sweep_options.hpp"

namespace skein::cli {

/// @param jobs  units at once (GNU parallel: on each host); nullopt: the engine's default, on this machine one per core
/// @throws InputError if the engine is not installed, or its options are not valid.
std::unique_ptr<SweepEngine> make_engine(const SweepOptions& options, std::optional<int> jobs,
                                         const SweepFolder& folder, const Console& console);

/// Writes the script that a node runs to fly unit $1. It changes to the sweep's working folder, sets this launcher's
/// SKEIN_* variables, and limits the unit's threads to its share of the node's cores.
/// @param jobs  as for make_engine()
void write_fly_script(const SweepFolder& folder, const std::filesystem::path& study,
                      const std::filesystem::path& working_folder, const std::optional<int>& jobs);
std::filesystem::path fly_script(const SweepFolder& folder);

/// The file with which another host starts the launcher; in a pack (`skein pack`), the script that finds its libraries.
std::filesystem::path launcher_file();

/// The options for sbatch in a text such as "partition=debug,time=10:00,exclude=a,b". An item without "=" continues the
/// value before it. @throws InputError for options that Skein sets itself, and for items that are not options.
std::vector<std::string> sbatch_options(const std::string& text);

}  // namespace skein::cli
