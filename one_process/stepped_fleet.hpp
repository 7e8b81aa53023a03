// A fleet in this process that flies a given number of steps and then stands still. It stands still within a step: the
// server has announced the step and holds it open (StepGate); the learners have written their observations; all other
// programs have answered the step. Observations, orders to the learners, and the truth are in one block of memory.
// Frame W.   Units: SI and radians.   Threads: one.   Deterministic: results do not depend on the steps per call.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/planners/block_layout.hpp"
#include "one_process/crew.hpp"
#include "process/status/shared_lines.hpp"
#include "process/status/status_pipe.hpp"
#include "sim_server/scene_shelf.hpp"
#include "sim_server/step_gate.hpp"
#include "station/score_view.hpp"
#include "uav_agent/api/learner.hpp"

namespace skein::one_process {

/// Thrown when a program of the fleet, or the fleet as a whole, has failed: it cannot be used any more.
struct FleetFailed {
  std::string program;  ///< the program that failed; empty: none in particular
  int code = 0, signal = 0;
  std::string why;  ///< a sentence
};

class SteppedFleet {
 public:
  /// @param starts  start orders of the programs, from the launcher. @param uavs  names in fleet order.
  /// @param seed  replaces the seed in `starts`. @param shelf  holds the scene, loaded in advance.
  /// @throws FleetFailed; std::logic_error when a start order has no seed.
  SteppedFleet(const std::vector<shared_lines::Start>& starts, const std::vector<std::string>& uavs, std::uint64_t seed,
               std::shared_ptr<sim::SceneShelf> shelf);
  ~SteppedFleet();
  SteppedFleet(const SteppedFleet&) = delete;
  SteppedFleet& operator=(const SteppedFleet&) = delete;

  /// Layout of the memory block; known before begin().
  const BlockLayout& layout() const;
  /// Starts the fleet, which then stands still in its first step. @param block  layout().bytes() zeros; must outlive
  /// this. @throws FleetFailed
  void begin(std::byte* block);
  /// Flies this many steps, or fewer if the run's last step comes before: then it ends the run.
  /// @throws FleetFailed; std::logic_error when the run is over.
  void step(std::uint64_t steps);
  /// Whether the run has ended.
  bool over() const;
  /// Digest, score, and each UAV's totals so far; see Truth.
  nlohmann::json result() const;
  /// Boxes and interest points, and the quality delivered of each point; see Truth.
  nlohmann::json scene() const;
  /// See Crew::turns(). May be called in any thread and in signal handlers.
  std::uint64_t turns() const;

 private:
  class Desk;
  void run();

  const std::shared_ptr<station::ScoreView> score_;
  const std::shared_ptr<Desk> desk_;
  StatusPipe pipe_{-1};
  Crew crew_;
};

}  // namespace skein::one_process
