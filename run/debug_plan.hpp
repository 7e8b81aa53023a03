// Resolves --debug and --log for the programs of a planned fleet.   Threads: any.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// The programs that --debug names, with their tools. @throws InputError for values that are not valid or not possible
std::vector<Debuggee> debuggees(const FleetPlan& plan);

/// The log levels of --log, by program. @throws InputError for values that are not valid
std::map<std::string, std::string> log_levels(const FleetPlan& plan);

}  // namespace skein::cli
