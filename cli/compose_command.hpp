// `skein compose`: writes a docker-compose file for a fleet in containers, or flies that fleet at once. `skein keys`:
// makes the keys of a secured fleet that is started by hand or by other tools.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// @returns the launcher's exit code. @throws InputError; std::runtime_error when the containers cannot be created.
int compose_fleet(const ComposeOptions& options, const Console& console);

/// @returns the exit code. @throws InputError when the folder exists already or cannot be created; std::system_error
///   when a key cannot be written.
int make_keys(const KeysOptions& options, const Console& console);

}  // namespace skein::cli
