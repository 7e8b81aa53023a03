#include "results/work.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>

#include "process/files/atomic_file.hpp"
#include "results/run_folder.hpp"

namespace skein::results {
namespace {

/// In fleet order; an empty track for a UAV whose work sim_server did not record.
std::vector<WorkTrack> tracks_of(const Scenario& scenario, const Reports& reports) {
  std::vector<WorkTrack> tracks(scenario.fleet.size());
  if (!reports.sim_server) return tracks;
  for (const UavIndex i : scenario.uavs()) {
    const auto& uavs = reports.sim_server->uavs;
    const auto found = std::ranges::find(uavs, Text(scenario.fleet[i].name), &UavReport::name);
    if (found == uavs.end() || !found->work) continue;
    tracks[i] = {found->work->open, {found->work->done.begin(), found->work->done.end()}};
  }
  return tracks;
}

std::vector<WaitSpan> waits_of(const Scenario& scenario, const std::optional<AgentReport>& agent) {
  std::vector<WaitSpan> spans;
  if (!agent || !agent->waits) return spans;
  const std::vector<std::string> names = scenario.uav_names();
  for (const WaitReport& wait : *agent->waits) {
    const auto mate = std::ranges::find(names, wait.uav.value_or(""));
    if (mate == names.end() || !wait.from_s || !wait.until_s) continue;
    spans.push_back({*wait.from_s, *wait.until_s, static_cast<std::size_t>(mate - names.begin())});
  }
  return spans;
}

}  // namespace

std::vector<std::optional<WorkTime>> work_times(const Scenario& scenario, const Reports& reports) {
  std::vector<std::vector<WaitSpan>> waits;
  for (const UavConfig& uav : scenario.fleet) {
    const auto agent = reports.agents.find(uav.name);
    waits.push_back(agent == reports.agents.end() ? std::vector<WaitSpan>() : waits_of(scenario, agent->second));
  }
  const std::vector<WorkTrack> tracks = tracks_of(scenario, reports);
  std::vector<WorkTime> judged = judge_work(tracks, waits);
  std::vector<std::optional<WorkTime>> times(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!tracks[i].open.empty()) times[i] = std::move(judged[i]);
  }
  return times;
}

void write_work_csv(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports) {
  const std::vector<WorkTrack> tracks = tracks_of(scenario, reports);
  const auto times = work_times(scenario, reports);
  std::size_t longest = 0;
  for (const auto& time : times) longest = std::max(longest, time ? time->seconds.size() : 0);
  std::string csv = "time_s,uav,open,work,waits_for,excused,frozen,without_work_s\n";
  for (std::size_t s = 0; s < longest; ++s) {
    for (const UavIndex i : scenario.uavs()) {
      if (!times[i] || s >= times[i]->seconds.size()) continue;
      const WorkSecond& second = times[i]->seconds[s];
      fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{}\n", s + 1, scenario.fleet[i].name,
                     tracks[i].open[s], Json(tracks[i].done[s]).dump(),
                     second.waits_for ? scenario.fleet[UavIndex(*second.waits_for)].name : "", second.excused ? 1 : 0,
                     second.frozen ? 1 : 0, second.without_work);
    }
  }
  write_file_atomically(dir / run_folder::kWork, csv);
}

}  // namespace skein::results
