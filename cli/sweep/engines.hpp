// The engines of `--executor`: this machine's cores, GNU parallel over ssh, Slurm. Each runs the sweep's own script,
// `fly`, with the number of a unit. From one thread, which must live as long as what they start.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/sweep/engine.hpp"
#include "cli/sweep/folder.hpp"

namespace skein::cli {

/// @param jobs  units at once, of parallel on each host; nullopt: as many as the engine likes, here as there are cores
/// @throws InputError when the engine is not installed, or its options make no sense.
std::unique_ptr<SweepEngine> make_engine(const SweepOptions& options, std::optional<int> jobs,
                                         const SweepFolder& folder, const Console& console);

/// What any node runs to fly unit $1: in the sweep's working folder, with this launcher's own variables, and with the
/// share of the node's cores that is its own.
/// @param jobs  as for make_engine()
void write_fly_script(const SweepFolder& folder, const std::filesystem::path& study,
                      const std::filesystem::path& working_folder, const std::optional<int>& jobs);
std::filesystem::path fly_script(const SweepFolder& folder);

/// The launcher as another host starts it: of a pack, the script that finds its libraries.
std::filesystem::path launcher_file();

/// Options of sbatch: "partition=debug,time=10:00,exclude=a,b". A piece without "=" goes on with the value before it.
/// @throws InputError for one that Skein sets itself, or for what is no option.
std::vector<std::string> sbatch_options(const std::string& text);

}  // namespace skein::cli
