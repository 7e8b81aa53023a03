// The programs of a planned run, and the command line of each.   Units: s.   Threads: one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/program_host.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

/// Arguments of one of Skein's programs that do not depend on the host that runs it. Its folders, run id, keys and
/// network are added elsewhere.
std::vector<std::string> program_arguments(const FleetPlan& plan, const std::string& program, int base_domain);

/// All programs of a fleet in the order in which they start, without those that the user starts (--debug).
/// @param secure  has all programs, or none
std::vector<ProgramSpec> fleet_programs(const FleetPlan& plan, int base_domain, const std::filesystem::path& out,
                                        const SecureFolders& secure = {});

/// The process that runs all programs of the fleet under --one-process.
ProgramSpec shared_process(const FleetPlan& plan, const std::filesystem::path& out);

/// The shell command with which the user runs a program in gdb (a user's command: without gdb).
std::string debug_command(const FleetPlan& plan, const std::string& program, int base_domain,
                          const std::filesystem::path& out, const SecureFolders& secure = {});

/// The executable file of a program of the fleet; for a user's command, that of the shell.
std::filesystem::path program_file(const FleetPlan& plan, const std::string& program);

/// Programs that only validate their input (--check): sim_server, one agent for each different planner, and the program
/// at the ground station. Users' commands are left out, since they need not know --check.
/// @param scratch  folder for their logs. @param agent_user  user that agents run as
std::vector<ProgramSpec> check_programs(const FleetPlan& plan, const std::filesystem::path& scratch,
                                        const std::optional<UserId>& agent_user = {});

}  // namespace skein::cli
