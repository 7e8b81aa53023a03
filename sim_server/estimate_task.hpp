// What could be had of a scene, asked of the oracle while the fleet flies: so that who watches is told what is lost,
// and to what. It takes what the machine has left, and nobody in the fleet hears of it.
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "oracle/cache.hpp"

namespace skein::sim {

class EstimateTask {
 public:
  /// Begins, in a thread of its own. @param scenario, scene  must outlive this. @param request  its `cache` keeps the
  /// answer for the launcher, which asks the same after the run.
  EstimateTask(const Scenario& scenario, const Scene& scene, OracleRequest request);

  /// As often as one likes, from one thread. @returns the answer, once: when it is there.
  std::optional<OracleSummary> take();
  /// Whether nothing more will come than what take() returns now.
  bool over() const { return done_; }

 private:
  std::optional<OracleSummary> answer_;
  std::atomic<bool> done_ = false;  ///< then answer_ is this side's
  std::jthread thread_;             ///< ends first
};

/// As `skein run` asks it. Nothing where it would take long.
OracleRequest estimate_request();

}  // namespace skein::sim
