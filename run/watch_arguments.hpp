// Arguments of programs for a run that a user watches, and in which they may fly UAVs by hand.   Pure.
#pragma once

#include <string>
#include <vector>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// Arguments of sim_server. @param plan  of a watched run.
std::vector<std::string> watch_arguments(const FleetPlan& plan);

/// Arguments of the station, which serves the page. @param plan  of a watched run.
std::vector<std::string> view_arguments(const FleetPlan& plan);

}  // namespace skein::cli
