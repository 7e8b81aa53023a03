// Environment variables for a user's command in place of uav_agent, and a check whether it can fly at all.
// Threads: one.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// The variables that do not depend on where the command runs: the time of an exchange, its radio topics and, unless it
/// runs at the ground station, its UAV's role.
std::map<std::string, std::string> part_variables(const FleetPlan& plan, const std::string& program);

/// All environment variables of a user's command (docs/how-to.md). The command joins only the DDS domain SKEIN_DOMAIN.
std::map<std::string, std::string> exec_variables(const FleetPlan& plan, const std::string& program, int base_domain,
                                                  const std::filesystem::path& out, const SecureFolder& secure);

/// @throws InputError if a secured fleet has ROS 2 nodes and RMW_IMPLEMENTATION does not select the fleet's DDS vendor
void check_exec(const FleetPlan& plan);

}  // namespace skein::cli
