#include "run/open_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/types.hpp"
#include "process/host/open_files.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {

OpenFilesNeed open_files_need(const FleetPlan& plan) {
  const std::uint64_t uavs = plan.scenario.fleet.size();
  if (plan.options.one_process) return {20 + uavs, 32 + 2 * uavs};  // measured: 20 + UAVs without a recording
  std::uint64_t programs = programs::kServers.size() + (plan.ground && takes_part(plan, "gcs") ? 1 : 0);
  for (const UavPlanner& planner : plan.planners) programs += takes_part(plan, planner.uav) ? 1 : 0;
  const auto domains = static_cast<std::uint64_t>(domain_count(plan));
  // The launcher has two pipes, the log and the pidfd of each program, and a lock on each domain.
  const std::uint64_t launcher = 10 + 4 * programs + domains;
  return {launcher, std::max(launcher, ample_open_files(domains))};
}

std::string check_open_files(const FleetPlan& plan, std::uint64_t limit) {
  const OpenFilesNeed need = open_files_need(plan);
  if (limit >= need.ample) return {};
  const std::string text = fmt::format(
      "a process may have {} open files (ulimit -n), and a fleet of {} UAVs needs about {}; raise the limit with "
      "`ulimit -n {}`, or as root with nofile in /etc/security/limits.conf",
      limit, plan.scenario.fleet.size(), need.ample, need.ample);
  if (limit < need.least) throw InputError(text);
  return text;
}

std::string check_open_files(const FleetPlan& plan) {
  const auto limit = open_files_limit();
  return limit && !plan.options.place.at ? check_open_files(plan, *limit) : std::string();
}

}  // namespace skein::cli
