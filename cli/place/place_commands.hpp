// `skein run --place ... --print`: for hosts on which the launcher cannot log in, the commands with which the user
// starts the programs of a fleet by hand on each host. Reads this host's name, and draws a random run id.
// Threads: any.
#pragma once

#include <string>
#include <vector>

#include "cli/place/placement.hpp"

namespace skein::cli {

/// A shell script with a part for each host, this one first, and at the end the commands that merge the results on this
/// host. The programs fly without a launcher: each of Skein's programs runs under a keeper process that restarts it
/// after a SIGKILL (--keep), and the server notices a program's death when its DDS lease expires (--lease).
std::string place_commands(const FleetPlan& plan, const std::vector<PlacedHost>& hosts);

}  // namespace skein::cli
