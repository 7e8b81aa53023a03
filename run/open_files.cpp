#include "run/open_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>

#include "results/run_folder.hpp"

namespace skein::cli {

namespace {

std::uint64_t launcher_files(const FleetPlan& plan) {
  std::uint64_t programs = programs::kServers.size() + (plan.ground && takes_part(plan, "gcs") ? 1 : 0);
  for (const UavPlanner& planner : plan.planners) programs += takes_part(plan, planner.uav) ? 1 : 0;
  return open_files_of_watcher(programs, static_cast<std::uint64_t>(domain_count(plan)));
}

/// Open files of the server and of the router, which both join all domains.
OpenFilesNeed server_files(const FleetPlan& plan) {
  const std::map<std::string, std::string> vendors = dds_vendors(plan);
  const bool fast = vendors.at(programs::kSimServer) == "fastdds" || vendors.at(programs::kCommRouter) == "fastdds";
  return open_files_over_dds(static_cast<std::uint64_t>(domain_count(plan)), fast);
}

/// Open files of the process with the whole fleet. Measured with 1 and 5 UAVs: 20 and one for each UAV; what is
/// recorded, maps that are kept and the page add to that.
std::uint64_t shared_process_files(const FleetPlan& plan) {
  const std::uint64_t uavs = plan.scenario.fleet.size();
  return 20 + uavs + (plan.options.record != "none" ? 5 : 0) + (plan.options.keep_maps_s ? uavs : 0) +
         (plan.options.view.at ? 5 : 0);
}

std::string fleet_text(const FleetPlan& plan) { return fmt::format("a fleet of {} UAVs", plan.scenario.fleet.size()); }

}  // namespace

OpenFilesNeed open_files_need(const FleetPlan& plan) {
  const std::uint64_t uavs = plan.scenario.fleet.size();
  if (plan.options.one_process) {
    const std::uint64_t least = shared_process_files(plan);
    return {least, std::max(least, 32 + 2 * uavs)};
  }
  const OpenFilesNeed server = server_files(plan);
  const std::uint64_t least = std::max(launcher_files(plan), server.least);
  return {least, std::max(least, server.ample)};
}

std::string allow_open_files(const FleetPlan& plan) {
  return provide_open_files(fleet_text(plan), open_files_need(plan));
}

void allow_launcher_open_files(const FleetPlan& plan) {
  const std::uint64_t need = launcher_files(plan);
  provide_open_files("the launcher of " + fleet_text(plan), {need, need});
}

}  // namespace skein::cli
