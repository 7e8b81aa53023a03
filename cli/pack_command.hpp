// `skein pack`.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein pack`: an archive of the programs with their libraries.
struct PackOptions {
  std::filesystem::path file;
  std::vector<std::filesystem::path> agents;  ///< the user's own agent programs, packed too
};

/// Adds the command `pack`, whose options CLI11 parses into the second argument.
void add_pack(CLI::App& app, PackOptions& pack);

/// `skein pack`: the programs with all libraries that they need, in one archive that runs wherever it is unpacked.
/// The archive gets its name only once it is complete and on the disk.
/// @throws InputError for a target that is a folder, or an agent or library that is not there; std::system_error or
///   std::runtime_error, with the archive's name, if the disk is full or tar fails.
int pack_programs(const PackOptions& options, const Console& console);

}  // namespace skein::cli
