// `skein compose`: writes a file for docker-compose with a fleet in containers, or flies that fleet at once. `skein
// keys`: makes the keys of a secured fleet that is started by hand or by other tools.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// @returns the launcher's exit code. @throws InputError; std::runtime_error when the containers cannot be created.
int compose_fleet(const ComposeOptions& options, const Console& console);

/// @throws InputError when the folder is there already, std::system_error when it cannot be written.
int make_keys(const KeysOptions& options, const Console& console);

}  // namespace skein::cli
