// `skein check`: is this file right? Scenarios, vehicles, fault files, fault tests, and tables of reference vectors.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Prints one line a file that is right. @throws InputError for the first file that is not.
/// @returns what sim_server's --golden ended with where reference vectors were given, else kExitDone.
int check_files(const CheckOptions& options, const Console& console);

}  // namespace skein::cli
