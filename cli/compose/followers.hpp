// Followers of a fleet's containers: for each container a process on this host that passes on its status lines, keeps
// its log, and ends as the container does. So the launcher supervises containers as it does processes.   Threads: any.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/compose/compose_file.hpp"
#include "host/program_host.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

/// The followers, those of the servers first. If a program is debugged `inside` its container, its follower starts gdb
/// in this terminal as soon as the program waits for a debugger.
/// @param containers  container ids, by program. @param out  folder of the logs
std::vector<ProgramSpec> followers(const std::map<std::string, std::string>& containers, const FleetPlan& plan,
                                   const ComposeLayout& layout, const std::filesystem::path& out);

}  // namespace skein::cli
