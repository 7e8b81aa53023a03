// The router's part when a recorded run is flown again: replaces the members' radio messages with the recorded ones.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "comm_router/router_sync.hpp"
#include "core/scenario/scenario.hpp"
#include "recording/replay.hpp"

namespace skein::router {

class ReplayNode {
 public:
  /// @param routes  of the scenario. @throws InputError when the file is not a recording, or when messages arrived on
  /// other routes: a run in which members registered topics cannot be flown again.
  ReplayNode(const Scenario& scenario, const std::vector<RadioRoute>& routes, const recording::ReplayOptions& options);

  /// While the replay lasts: replaces the step's messages with the recorded ones, and notes where the two differ.
  void replace(StepBatch& batch);
  const recording::Differences& differences() const { return differences_; }

 private:
  const Scenario& scenario_;
  const std::vector<RadioRoute>& routes_;
  const recording::ReplayOptions options_;
  std::map<std::string, std::size_t> by_topic_;  ///< name in the recording to route
  recording::RecordedRun run_;
  recording::Differences differences_;
};

}  // namespace skein::router
