// What a user wants to look into, of the fleet that he has.   Threads: any.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// Whom --debug names, and how. @throws InputError for what is wrong in it, or cannot be
std::vector<Debuggee> debuggees(const FleetPlan& plan);

/// Of --log, by program. @throws InputError for what is wrong in it
std::map<std::string, std::string> log_levels(const FleetPlan& plan);

}  // namespace skein::cli
