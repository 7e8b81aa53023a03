// Delays of the commands to a vehicle: some vehicles get them one exchange late, a fault may add exchanges, and the
// motors start with a delay.   Units: ticks, exchanges.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "core/types.hpp"
#include "sim_server/flight/fleet_start.hpp"

namespace skein::sim {

/// Commands to a vehicle: the newest one of each kind.
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

  /// Additional exchanges, after the next one, until a command that is sent now takes effect. @param delay  as for
  /// exchange().
  int latency(int delay = 0) const { return delay + (late_ ? 1 : 0); }

  /// Put commands in here at a step boundary.
  Commands& outbox() { return sent_; }

  /// Begins a new exchange at `tick`. A command arrives when its age reaches the delay in force at that time. So no
  /// command overtakes another when the delay changes.
  /// @param delay  exchanges, in addition to the vehicle's own latency.
  /// @returns the commands that arrive with this exchange, the newest of each kind. Do not apply its trajectory: get
  ///   that from take_trajectory().
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

  /// The setpoint that arrived since the last call; nullopt: none, or the motors have not started yet.
  std::optional<TrajectoryCommand> take_trajectory(Tick tick) {
    if (!motors_start_ || tick < *motors_start_) return std::nullopt;
    return std::exchange(waiting_, std::nullopt);
  }

 private:
  Tick motor_delay_;
  bool late_;
  Commands sent_;
  std::deque<Commands> in_flight_;  ///< one entry per exchange, oldest first
  std::optional<TrajectoryCommand> waiting_;
  std::optional<Tick> motors_start_;
};

}  // namespace skein::sim
