#include "sim_server/record/activity_log.hpp"

#include <spdlog/fmt/fmt.h>

#include "results/run_folder.hpp"
#include "results/run_tables.hpp"

namespace skein::sim {

ActivityLog::ActivityLog(const std::filesystem::path& folder, const Scenario& scenario)
    : scenario_(scenario), out_(folder / run_folder::kActivity), last_(scenario.fleet.size()) {
  out_ << run_tables::kActivityColumns << "\n";
  out_.flush();  // so that a server that is killed leaves a table without rows, not an empty file
}

bool ActivityLog::add(const Simulation& simulation, UavIndex uav, const Activity& activity) {
  Activity logged = activity;  // without the values for which the table has no column
  logged.speed_mps = logged.cpu_s = 0.0;
  logged.undelivered = 0;
  std::optional<Activity>& last = last_[uav];
  if (last == logged) return false;
  const auto& goal_W = logged.goal_W;
  const std::string goal = goal_W ? fmt::format("{:.2f},{:.2f},{:.2f}", goal_W->x(), goal_W->y(), goal_W->z()) : ",,";
  out_ << fmt::format("{},{:.2f},{},{},{},{},{}\n", simulation.step(), seconds(simulation.tick()),
                      scenario_.fleet[uav].name, logged.mode, goal, logged.waits_for, logged.no_way);
  last = std::move(logged);
  return true;
}

}  // namespace skein::sim
