// Writes events.csv: the events that decide whether a capture reaches the station, as the server saw them. The file
// has one line per event, in the order of steps. An event takes effect at its step.
//   joined, left          the program `subject` becomes a member of the run, or is one no longer
//   link_up, link_down    the directed radio link from `subject` to `object` opens or closes. A link is open with line
//                         of sight, within its range and with a sufficient signal, unless a fault cuts it
//   captured              the camera of the UAV `subject` hands the capture with number `object` to the agent
//   released              the agent of the UAV `subject` confirms that the station has the capture `object`
// Times are simulated seconds.   Not thread-safe.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/scenario/scenario.hpp"
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

  /// Call once at the end of each step. @param is_member  returns whether the program of this name is a member.
  void add_step(const Simulation& simulation, const std::function<bool(const std::string&)>& is_member);
  /// Logs that the station's acknowledgement of a capture has reached the UAV: the event `released`.
  void add_release(const Simulation& simulation, const std::string& uav, std::uint64_t capture);
  StreamFile& file() { return out_; }
  /// Registers a listener. It is called with each event from now on, before the event is written to the file.
  void tell(std::function<void(const LoggedEvent&)> listener) { listeners_.push_back(std::move(listener)); }

 private:
  void add(const Simulation& simulation, const char* event, const std::string& subject, const std::string& object);

  const Scenario& scenario_;
  StreamFile out_;
  std::vector<std::function<void(const LoggedEvent&)>> listeners_;
  std::vector<std::string> members_;
  std::vector<bool> present_;  ///< for each of members_: whether it was a member at the last add_step()
  Links links_;                ///< open links at the last add_step()
};

}  // namespace skein::sim
