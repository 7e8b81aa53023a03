// Writes activity.csv: what each UAV did and why, as its program reported (topic /{id}/activity). The file has a line
// when a UAV's mode, its goal, the UAV that it waits for, or the reason why it finds no path has changed; at most one
// line per UAV and step, in the order of steps. Other values (speed, CPU time) are left out, so that a run that is
// flown again leaves the same file.   Times in simulated seconds, positions in W [m].   Not thread-safe.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/messages/activity.hpp"
#include "core/scenario/scenario.hpp"
#include "process/files/stream_file.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class ActivityLog {
 public:
  /// @throws std::runtime_error when the file cannot be written.
  ActivityLog(const std::filesystem::path& folder, const Scenario& scenario);

  /// @returns whether the activity has changed; changes of speed, CPU time and undelivered captures do not count.
  bool add(const Simulation& simulation, UavIndex uav, const Activity& activity);
  StreamFile& file() { return out_; }

 private:
  const Scenario& scenario_;
  StreamFile out_;
  std::vector<std::optional<Activity>> last_;  ///< by UAV
};

}  // namespace skein::sim
