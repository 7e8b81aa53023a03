// A fleet in this process that goes on by so many steps as it is told, and then stands still. It stands when a step is
// told to all: everybody has answered it but the learners, who have looked, and the server, which holds it. What the
// learners see and what they are told, and the truth, lie in one block of memory.
// Frame W.   Units: SI and radians.   Threads: one.   Deterministic: how many steps are taken at once changes nothing.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/block_layout.hpp"
#include "one_process/crew.hpp"
#include "process/status/shared_lines.hpp"
#include "process/status/status_pipe.hpp"
#include "sim_server/scene_shelf.hpp"
#include "sim_server/step_gate.hpp"
#include "station/score_view.hpp"
#include "uav_agent/api/learner.hpp"

namespace skein::one_process {

/// A program of the fleet has failed, or the fleet as a whole: nothing more can be had of it.
struct FleetFailed {
  std::string program;  ///< empty: no one in particular
  int code = 0, signal = 0;
  std::string why;  ///< a sentence
};

class SteppedFleet {
 public:
  /// @param starts  of its programs, as the launcher has them. @param uavs  names in fleet order.
  /// @param seed  instead of what those say. @param shelf  with their scene. @throws FleetFailed
  SteppedFleet(const std::vector<shared_lines::Start>& starts, const std::vector<std::string>& uavs, std::uint64_t seed,
               std::shared_ptr<sim::SceneShelf> shelf);
  ~SteppedFleet();
  SteppedFleet(const SteppedFleet&) = delete;
  SteppedFleet& operator=(const SteppedFleet&) = delete;

  /// Before begin(): where what lies in the block.
  const BlockLayout& layout() const;
  /// Starts the fleet, up to its first step. @param block  zeroes; must outlive this.
  /// @throws FleetFailed, as step() does.
  void begin(std::byte* block);
  /// Goes on by so many steps, or to the run's last one, which it ends. Not after that.
  void step(std::uint64_t steps);
  /// The run has ended.
  bool over() const;
  /// Digest, score and what each UAV did, until now.
  nlohmann::json result() const;
  /// Where the structure, the boxes and the interest points are, and what was delivered of each.
  nlohmann::json scene() const;
  /// See Crew::turns(); from any thread and from handlers of signals.
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
