// Which files each program of a fleet reads, for programs that run where this host's files are not: in containers, on
// other hosts. An agent gets neither meshes nor interest points.   Threads: any.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// The file FILE of NAME:FILE, which holds a planner's parameters, as written; empty: there is none.
std::filesystem::path parameter_file(const UavPlanner& planner);

/// Of the scenario and the fault file: what this program reads, as the plan names it.
std::vector<std::filesystem::path> scenario_files(const FleetPlan& plan, const std::string& program);

/// Of an agent's planner: its parameters, its source in Python and the modules beside that. Of other programs: none.
std::vector<std::filesystem::path> planner_files(const FleetPlan& plan, const std::string& program);

}  // namespace skein::cli
