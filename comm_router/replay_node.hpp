// The router's part of a run that is flown again: the radio messages of then in the place of those of now.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "comm_router/router_sync.hpp"
#include "core/scenario.hpp"
#include "recording/replay.hpp"

namespace skein::router {

class ReplayNode {
 public:
  /// @param routes  of the scenario. @throws InputError when the recording is none, or has messages on other routes:
  /// topics that were registered while it was flown cannot be flown again.
  ReplayNode(const Scenario& scenario, const std::vector<RadioRoute>& routes, const recording::ReplayOptions& options);

  /// As long as the replay lasts: the step's messages become those of then.
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
