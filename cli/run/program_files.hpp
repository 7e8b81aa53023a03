// Lists the files that each program of a fleet reads, for programs that run without access to this host's files: in
// containers and on other hosts. Only sim_server gets the files of the scene.   Threads: any.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// The parameter file of a planner NAME:FILE, as the user wrote its path; empty: there is none.
std::filesystem::path parameter_file(const UavPlanner& planner);

/// The files of the scenario and the faults that this program reads, with the paths of the plan.
std::vector<std::filesystem::path> scenario_files(const FleetPlan& plan, const std::string& program);

/// The files of an agent's planner: parameters, Python source, and the modules beside it. None for other programs.
std::vector<std::filesystem::path> planner_files(const FleetPlan& plan, const std::string& program);

}  // namespace skein::cli
