// `skein pack`: the programs with all libraries that they need, in one archive that runs wherever it is unpacked.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @returns the exit code. @throws InputError for a target that is a folder, an agent or library that is not there, or
/// when tar fails.
int pack_programs(const PackOptions& options, const Console& console);

}  // namespace skein::cli
