// `skein check`: checks scenario, vehicle and fault files, fault tests, and tables of reference vectors.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Prints one line for each valid file. @throws InputError for the first invalid file.
/// @returns the exit code of `sim_server --golden` if reference vectors were given, else kExitDone.
int check_files(const CheckOptions& options, const Console& console);

}  // namespace skein::cli
