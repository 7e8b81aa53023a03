// What programs are told of a run that somebody looks on, and perhaps flies by hand.
#pragma once

#include <string>
#include <vector>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// sim_server.   @param plan  of a run that is watched.
std::vector<std::string> watch_arguments(const FleetPlan& plan);

/// The station, to serve the page.   @param plan  as above.
std::vector<std::string> view_arguments(const FleetPlan& plan);

}  // namespace skein::cli
