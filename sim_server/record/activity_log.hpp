// activity.csv: what each UAV did and why, as its program said (topic /{id}/activity). One line when what it does, its
// goal, whom it waits for, or why it finds no way has changed, and one a UAV in a step at most; in the order of steps.
// Numbers are left out, so that a run that is flown again leaves the same file.
// Times in simulated seconds, places in W [m].   Not thread-safe.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/activity.hpp"
#include "core/scenario.hpp"
#include "process/files/stream_file.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class ActivityLog {
 public:
  /// @throws std::runtime_error when the file cannot be written.
  ActivityLog(const std::filesystem::path& folder, const Scenario& scenario);

  /// @returns whether it is news: numbers alone are none.
  bool add(const Simulation& simulation, UavIndex uav, const Activity& activity);
  StreamFile& file() { return out_; }

 private:
  const Scenario& scenario_;
  StreamFile out_;
  std::vector<std::optional<Activity>> last_;  ///< by UAV
};

}  // namespace skein::sim
