// The options of `skein run` that place programs on other hosts.
#pragma once

#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Adds --place, --ssh, --skein-path and --print.
void add_place_options(CLI::App& command, PlaceOptions& place);

}  // namespace skein::cli
