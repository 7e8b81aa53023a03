#include "run/open_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/types.hpp"
#include "process/host/open_files.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {

namespace {

/// Open files of the launcher: two pipes, the log and the pidfd of each program, and a lock on each domain.
std::uint64_t launcher_files(const FleetPlan& plan) {
  std::uint64_t programs = programs::kServers.size() + (plan.ground && takes_part(plan, "gcs") ? 1 : 0);
  for (const UavPlanner& planner : plan.planners) programs += takes_part(plan, planner.uav) ? 1 : 0;
  return 10 + 4 * programs + static_cast<std::uint64_t>(domain_count(plan));
}

/// Open files of a server that joins all domains, with two to spare. As measured with 1 and 5 UAVs and everything
/// recorded, it has 15 and 7 for each domain over Cyclone DDS, 18 and 8 over Fast DDS. With fewer, the vendor ends the
/// program when it joins the last domains. A secured server has fewer, since it does not use multicast.
std::uint64_t server_files(const FleetPlan& plan) {
  const auto domains = static_cast<std::uint64_t>(domain_count(plan));
  const std::map<std::string, std::string> vendors = dds_vendors(plan);
  const bool fast = vendors.at(programs::kSimServer) == "fastdds" || vendors.at(programs::kCommRouter) == "fastdds";
  return fast ? 20 + 8 * domains : 17 + 7 * domains;
}

/// Open files of the process with the whole fleet. Measured with 1 and 5 UAVs: 20 and one for each UAV; what is
/// recorded, maps that are kept and the page add to that.
std::uint64_t shared_process_files(const FleetPlan& plan) {
  const std::uint64_t uavs = plan.scenario.fleet.size();
  return 20 + uavs + (plan.options.record != "none" ? 5 : 0) + (plan.options.keep_maps_s ? uavs : 0) +
         (plan.options.view.at ? 5 : 0);
}

/// @returns a warning when `limit` may be too low; empty: it is not. @throws InputError if `who` cannot start
std::string judge(const std::string& who, const OpenFilesNeed& need, std::uint64_t limit) {
  if (limit >= need.ample) return {};
  const std::string text = fmt::format(
      "a process may have {} open files (ulimit -n), and {} needs about {}; as root, raise the limit with `ulimit -n "
      "{}`, "
      "or with nofile in /etc/security/limits.conf",
      limit, who, need.ample, need.ample);
  if (limit < need.least) throw InputError(text);
  return text;
}

std::string fleet_text(const FleetPlan& plan) { return fmt::format("a fleet of {} UAVs", plan.scenario.fleet.size()); }

}  // namespace

OpenFilesNeed open_files_need(const FleetPlan& plan) {
  const std::uint64_t uavs = plan.scenario.fleet.size();
  if (plan.options.one_process) {
    const std::uint64_t least = shared_process_files(plan);
    return {least, std::max(least, 32 + 2 * uavs)};
  }
  const std::uint64_t least = std::max(launcher_files(plan), server_files(plan));
  return {least, std::max(least, ample_open_files(static_cast<std::uint64_t>(domain_count(plan))))};
}

std::string check_open_files(const FleetPlan& plan, std::uint64_t limit) {
  return judge(fleet_text(plan), open_files_need(plan), limit);
}

std::string allow_open_files(const FleetPlan& plan) {
  raise_open_files_limit(open_files_need(plan).ample);
  const auto limit = open_files_limit();
  return limit ? check_open_files(plan, *limit) : std::string();
}

void allow_launcher_open_files(const FleetPlan& plan) {
  const std::uint64_t need = launcher_files(plan);
  raise_open_files_limit(need);
  const auto limit = open_files_limit();
  if (limit) judge("the launcher of " + fleet_text(plan), {need, need}, *limit);
}

}  // namespace skein::cli
