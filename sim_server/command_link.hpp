// Commands on their way to a vehicle: some vehicles hear them one exchange late, and motors take their time to start.
#pragma once

#include <optional>
#include <utility>

#include "core/types.hpp"
#include "sim_server/fleet_start.hpp"

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

  /// Where commands are put at a step boundary.
  Commands& outbox() { return sent_; }

  /// A new exchange begins at `tick`. @returns what arrives with it; its trajectory is for take_trajectory() alone.
  Commands exchange(Tick tick) {
    Commands arrived = late_ ? in_flight_ : sent_;
    in_flight_ = sent_;
    sent_ = {};
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
  Commands sent_, in_flight_;
  std::optional<TrajectoryCommand> waiting_;
  std::optional<Tick> motors_start_;
};

}  // namespace skein::sim
