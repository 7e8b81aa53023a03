// `skein convert`: turns fault tests of earlier versions into those of this one.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Prints the converted text of each file; with `--in-place` rewrites the files that change, and prints their names.
/// @returns the exit code. @throws InputError for the first file that cannot be read or converted.
int convert_files(const ConvertOptions& options, const Console& console);

}  // namespace skein::cli
