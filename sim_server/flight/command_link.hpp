// Commands on their way to a vehicle: some vehicles hear them one exchange late, a fault may delay them further, and
// motors take their time to start.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "core/types.hpp"
#include "sim_server/flight/fleet_start.hpp"

namespace skein::sim {

/// What a vehicle was told; in each slot the newest.
struct Commands {
  std::optional<TrajectoryCommand> trajectory;
  std::optional<GimbalCommand> gimbal;
  bool trigger = false;
  bool stop = false;
};

/// One UAV's link. Not thread-safe.
class CommandLink {
 public:
  explicit CommandLink(const UavStart& start) : motor_delay_(start.motor_delay), late_(start.late_commands) {}

  /// Exchanges after the next one until what is sent now takes effect. @param delay  as for exchange().
  int latency(int delay = 0) const { return delay + (late_ ? 1 : 0); }

  /// Where commands are put at a step boundary.
  Commands& outbox() { return sent_; }

  /// A new exchange begins at `tick`. Commands arrive once they are as old as the delay that is in force then, so that
  /// none overtakes another when it changes.
  /// @param delay  exchanges, on top of the vehicle's own latency.
  /// @returns what arrives with it, the newest of each kind; its trajectory is for take_trajectory() alone.
  Commands exchange(Tick tick, int delay = 0) {
    in_flight_.push_back(std::exchange(sent_, {}));
    const auto age = static_cast<std::size_t>(latency(delay));
    Commands arrived;
    for (; in_flight_.size() > age; in_flight_.pop_front()) {
      const Commands& next = in_flight_.front();
      if (next.trajectory) arrived.trajectory = next.trajectory;
      if (next.gimbal) arrived.gimbal = next.gimbal;
      arrived.trigger |= next.trigger;
      arrived.stop |= next.stop;
    }
    if (arrived.trajectory) {
      waiting_ = arrived.trajectory;
      if (!motors_start_) motors_start_ = tick + motor_delay_;
    }
    return arrived;
  }

  /// The set-point that arrived since the last call, if any did and the motors may run.
  std::optional<TrajectoryCommand> take_trajectory(Tick tick) {
    if (!motors_start_ || tick < *motors_start_) return std::nullopt;
    return std::exchange(waiting_, std::nullopt);
  }

 private:
  Tick motor_delay_;
  bool late_;
  Commands sent_;
  std::deque<Commands> in_flight_;  ///< one an exchange, oldest first
  std::optional<TrajectoryCommand> waiting_;
  std::optional<Tick> motors_start_;
};

}  // namespace skein::sim
