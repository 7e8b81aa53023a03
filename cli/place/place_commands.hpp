// `skein run --place ... --print`: commands to type on each host, if the launcher cannot start programs there. Reads
// this host's name, and draws a run id.   Threads: any.
#pragma once

#include <string>
#include <vector>

#include "cli/place/placement.hpp"

namespace skein::cli {

/// A shell script with a part for each host. The programs need no launcher: each restarts itself (--keep), and the
/// server detects by their leases which of them have died.
std::string place_commands(const FleetPlan& plan, const std::vector<PlacedHost>& hosts);

}  // namespace skein::cli
