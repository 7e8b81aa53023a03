// What a command of the user's in the place of uav_agent is told, and when there cannot be one.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// Environment variables of an agent that is a user's command (README.md). It joins SKEIN_DOMAIN and no other.
std::map<std::string, std::string> exec_variables(const FleetPlan& plan, const std::string& program, int base_domain,
                                                  const std::filesystem::path& out, const SecureFolder& secure);

/// @throws InputError for a ROS 2 node in a secured fleet
void check_exec(const FleetPlan& plan);

}  // namespace skein::cli
