// `skein pack`: the programs with all libraries that they need, in one archive that flies wherever it is unpacked.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @returns the exit code. @throws InputError for an agent that is no program, or an archive that cannot be written.
int pack_programs(const PackOptions& options, const Console& console);

}  // namespace skein::cli
