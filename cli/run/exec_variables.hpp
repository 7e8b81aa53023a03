// What a command of the user's in the place of uav_agent is told, and when there cannot be one.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// What such a program is told wherever it runs: its radio topics and, unless it is the ground station's, its UAV's
/// role.
std::map<std::string, std::string> part_variables(const FleetPlan& plan, const std::string& program);

/// Environment variables of an agent that is a user's command (README.md). It joins SKEIN_DOMAIN and no other.
std::map<std::string, std::string> exec_variables(const FleetPlan& plan, const std::string& program, int base_domain,
                                                  const std::filesystem::path& out, const SecureFolder& secure);

/// @throws InputError for a ROS 2 node of another DDS vendor in a secured fleet
void check_exec(const FleetPlan& plan);

}  // namespace skein::cli
