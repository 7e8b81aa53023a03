// Asks the oracle, while the fleet flies, which score is attainable in the scene. With the answer the page of a watched
// run shows what was lost, and why. The task runs at the lowest priority, and no agent receives the answer.
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "oracle/cache.hpp"

namespace skein::sim {

class EstimateTask {
 public:
  /// Starts a thread that asks. @param scenario, scene  must outlive this. @param request  its `cache` keeps the answer
  /// for the launcher, which asks the same after the run.
  EstimateTask(const Scenario& scenario, const Scene& scene, OracleRequest request);

  /// May be called at any time, always from the same thread. @returns the answer, once; nullopt before and afterwards.
  std::optional<OracleSummary> take();
  /// Whether the oracle has finished. Then take() returns its answer, if it gave one.
  bool over() const { return done_; }

 private:
  std::optional<OracleSummary> answer_;
  std::atomic<bool> done_ = false;  ///< the thread no longer touches answer_
  std::jthread thread_;             ///< last member: joined before the others are destroyed
};

/// The request that `skein run` makes, too. There is no answer if computing it would take long.
OracleRequest estimate_request();

}  // namespace skein::sim
