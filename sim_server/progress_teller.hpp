// Tells the launcher how far the run is: a few times a second, and at once when the mission enters another phase.
// Threads: one.
#pragma once

#include <chrono>
#include <vector>

#include "process/status/status_pipe.hpp"
#include "sim_server/record/run_files.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class ProgressTeller {
 public:
  static constexpr std::chrono::milliseconds kPeriod{200};

  /// Both must outlive this.
  ProgressTeller(const Scenario& scenario, StatusPipe& status) : scenario_(scenario), status_(status) {}

  /// Call it often: it sends only when a message is due. @param lost  all programs that were lost so far.
  void tell(const Simulation& simulation, const std::vector<LostProcess>& lost);
  /// Sends at once, even if the last message was just sent.
  void tell_now(const Simulation& simulation, const std::vector<LostProcess>& lost);

 private:
  using Clock = std::chrono::steady_clock;

  const Scenario& scenario_;
  StatusPipe& status_;
  Clock::time_point last_told_{};
  Phase last_phase_ = Phase::waiting;  ///< as last told
};

}  // namespace skein::sim
