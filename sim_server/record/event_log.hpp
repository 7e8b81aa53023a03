// events.csv: what decides whether a capture reaches the station, as the server saw it. One line an event, in the order
// of steps; an event is in force from its step on.
//   joined, left          a program takes part in the run, or no longer
//   link_up, link_down    a directed radio link: from, to; line of sight less what faults cut
//   captured, released    a UAV's capture: handed out by the camera with this step; acknowledged to the UAV in it
// Times in simulated seconds.   Not thread-safe.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/scenario.hpp"
#include "process/files/stream_file.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

struct LoggedEvent {
  std::uint64_t step = 0;
  Tick tick = 0;
  std::string event, subject, object;
};

class EventLog {
 public:
  /// @throws std::runtime_error when the file cannot be written.
  EventLog(const std::filesystem::path& folder, const Scenario& scenario);

  /// Once a step, as it ends. @param is_member  of the run, by name.
  void add_step(const Simulation& simulation, const std::function<bool(const std::string&)>& is_member);
  /// The station's acknowledgement has reached the UAV.
  void add_release(const Simulation& simulation, const std::string& uav, std::uint64_t capture);
  StreamFile& file() { return out_; }
  /// Who is told of each event, too.
  void tell(std::function<void(const LoggedEvent&)> listener) { listeners_.push_back(std::move(listener)); }

 private:
  void add(const Simulation& simulation, const char* event, const std::string& subject, const std::string& object);

  const Scenario& scenario_;
  StreamFile out_;
  std::vector<std::function<void(const LoggedEvent&)>> listeners_;
  std::vector<std::string> members_;
  std::vector<bool> present_;  ///< by members_
  Links links_;                ///< as last told
};

}  // namespace skein::sim
