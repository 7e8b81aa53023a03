// The options of `skein run` for programs on other hosts.
#pragma once

#include "cli/command.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// --place, --ssh, --skein-path, --print.
void add_place_options(CLI::App& command, PlaceOptions& place);

}  // namespace skein::cli
