// `skein run --place ... --print`: what to type on each host where nothing starts the programs for one.   Pure.
#pragma once

#include <string>
#include <vector>

#include "cli/place/placement.hpp"

namespace skein::cli {

/// A shell script in parts, one a host. The programs need no launcher: each keeps itself alive, and the server finds
/// out which of them died.
std::string place_commands(const FleetPlan& plan, const std::vector<PlacedHost>& hosts);

}  // namespace skein::cli
