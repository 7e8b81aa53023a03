// `skein compose`: a fleet in containers, as a file for docker-compose or flown at once. `skein keys`: the keys of a
// secured fleet that others start.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// @returns the launcher's exit code. @throws InputError, std::runtime_error when containers cannot be made.
int compose_fleet(const ComposeOptions& options, const Console& console);

/// @throws InputError when the folder is there already, std::system_error when it cannot be written.
int make_keys(const KeysOptions& options, const Console& console);

}  // namespace skein::cli
