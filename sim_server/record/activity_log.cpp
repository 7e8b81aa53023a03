#include "sim_server/record/activity_log.hpp"

#include <spdlog/fmt/fmt.h>

#include "results/run_folder.hpp"
#include "results/run_tables.hpp"

namespace skein::sim {

ActivityLog::ActivityLog(const std::filesystem::path& folder, const Scenario& scenario)
    : scenario_(scenario), out_(folder / run_folder::kActivity), last_(scenario.fleet.size()) {
  out_ << run_tables::kActivityColumns << "\n";
  out_.flush();  // see event_log.cpp
}

bool ActivityLog::add(const Simulation& simulation, UavIndex uav, const Activity& activity) {
  Activity words = activity;
  words.speed_mps = words.cpu_s = 0.0;
  words.undelivered = 0;
  std::optional<Activity>& last = last_[uav];
  if (last == words) return false;
  const auto& goal_W = words.goal_W;
  const std::string goal = goal_W ? fmt::format("{:.2f},{:.2f},{:.2f}", goal_W->x(), goal_W->y(), goal_W->z()) : ",,";
  out_ << fmt::format("{},{:.2f},{},{},{},{},{}\n", simulation.step(), seconds(simulation.tick()),
                      scenario_.fleet[uav].name, words.mode, goal, words.waits_for, words.no_way);
  last = std::move(words);
  return true;
}

}  // namespace skein::sim
