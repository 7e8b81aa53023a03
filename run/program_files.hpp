// Lists the files that each program of a fleet reads, for programs that run without access to this host's files: in
// containers and on other hosts. Only sim_server gets the files of the scene.   Threads: any.
#pragma once

#include <filesystem>
#include <vector>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// The parameter file of a planner `NAME:FILE`, with its path as the user wrote it; empty if there is none.
std::filesystem::path parameter_file(const UavPlanner& planner);

/// The files that this program reads of the scenario, of its vehicles and of the faults; for sim_server, also the files
/// of the scene. The paths are those in the plan.
std::vector<std::filesystem::path> scenario_files(const FleetPlan& plan, const std::string& program);

/// The files of an agent's planner: its parameters, its Python source, and the modules beside that source. For other
/// programs, there are none.
std::vector<std::filesystem::path> planner_files(const FleetPlan& plan, const std::string& program);

}  // namespace skein::cli
