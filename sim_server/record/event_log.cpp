#include "sim_server/record/event_log.hpp"

#include <spdlog/fmt/fmt.h>

#include "results/run_folder.hpp"
#include "results/run_tables.hpp"

namespace skein::sim {

EventLog::EventLog(const std::filesystem::path& folder, const Scenario& scenario)
    : scenario_(scenario), out_(folder / run_folder::kEvents), members_(scenario.uav_names()) {
  members_.insert(members_.end(), {scenario.node_name(kStationNode), programs::kStation, programs::kCommRouter});
  present_.resize(members_.size());
  links_ = Links(scenario.fleet.size() + 1);
  out_ << run_tables::kEventColumns << "\n";
  out_.flush();  // so that a server that is killed leaves a table without rows, not an empty file
}

void EventLog::add_step(const Simulation& simulation, const std::function<bool(const std::string&)>& is_member) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const bool present = is_member(members_[i]);
    if (present != present_[i]) add(simulation, present ? run_tables::kJoined : run_tables::kLeft, members_[i], "");
    present_[i] = present;
  }
  const Links& links = simulation.open_links();
  for (const Node from : scenario_.nodes()) {
    for (const Node to : scenario_.nodes()) {
      const bool linked = links.at(from, to) != 0;
      if (linked == (links_.at(from, to) != 0) || from == to) continue;
      add(simulation, linked ? run_tables::kLinkUp : run_tables::kLinkDown, scenario_.node_name(from),
          scenario_.node_name(to));
    }
  }
  links_ = links;
  for (const CaptureEvent& event : simulation.events().captures) {
    if (!event.report) continue;
    add(simulation, run_tables::kCaptured, scenario_.fleet[event.uav].name, std::to_string(event.report->capture));
  }
}

void EventLog::add_release(const Simulation& simulation, const std::string& uav, std::uint64_t capture) {
  add(simulation, run_tables::kReleased, uav, std::to_string(capture));
}

void EventLog::add(const Simulation& simulation, const char* event, const std::string& subject,
                   const std::string& object) {
  for (const auto& tell : listeners_) tell({simulation.step(), simulation.tick(), event, subject, object});
  out_ << fmt::format("{},{:.2f},{},{},{}\n", simulation.step(), seconds(simulation.tick()), event, subject, object);
}

}  // namespace skein::sim
