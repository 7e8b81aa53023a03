// What follows the containers of a fleet here: for each of them a program that hears its status lines, keeps its log
// and ends as it does. So the launcher looks after containers as it does after processes.   Threads: any.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/compose/compose_file.hpp"
#include "cli/host/program_host.hpp"
#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// Programs that follow them, the servers' first. The one of a program that is debugged `inside` its container has gdb
/// in this terminal as soon as that program stands there.
/// @param containers  of the engine, by program. @param out  folder of the logs
std::vector<ProgramSpec> followers(const std::map<std::string, std::string>& containers, const FleetPlan& plan,
                                   const ComposeLayout& layout, const std::filesystem::path& out);

}  // namespace skein::cli
