#include "sim_server/progress_teller.hpp"

#include "process/status/status_lines.hpp"

namespace skein::sim {

void ProgressTeller::tell(const Simulation& simulation, const std::vector<LostProcess>& lost) {
  if (simulation.mission().phase() == last_phase_ && Clock::now() - last_told_ < kPeriod) return;
  tell_now(simulation, lost);
}

void ProgressTeller::tell_now(const Simulation& simulation, const std::vector<LostProcess>& lost) {
  const Mission& mission = simulation.mission();
  last_told_ = Clock::now();
  last_phase_ = mission.phase();
  status::Progress progress{.time_s = seconds(simulation.tick()),
                            .mission_s = 0.0,
                            .duration_s = scenario_.duration_s,
                            .phase = mission.phase(),
                            .in_contact = {},
                            .lost = {}};
  if (mission.start_tick()) progress.mission_s = seconds(simulation.tick() - *mission.start_tick());
  for (const UavIndex i : FirstUavs(simulation.size())) {
    const bool in_contact = simulation.open_links().at(kStationNode, node_of_uav(i));
    if (in_contact) progress.in_contact.push_back(scenario_.fleet[i].name);
    progress.alive += simulation.uav(i).alive;
  }
  for (const LostProcess& process : lost) {
    if (!process.back) progress.lost.push_back(process.name);
  }
  status_.send(status::line_json(progress));
}

}  // namespace skein::sim
