// `skein compose`: a fleet in containers.
#pragma once

#include "cli/compose_options.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// `skein compose`: writes a docker-compose file for a fleet in containers, or flies that fleet at once.
/// @throws InputError; std::runtime_error when the containers cannot be created.
int compose_fleet(const ComposeOptions& options, const Console& console);

}  // namespace skein::cli
