// A UAV that a whole flight core flies, for tests without a strategy and without physics.
// Frame W.   Units: SI.
#pragma once

#include "uav_agent/flight_core/flight_core.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {

struct CoreUav : FlownUav {
  using FlownUav::FlownUav;
  /// Executes the steering of this exchange, and moves the UAV on by one exchange.
  void fly_by(const Steering& steering) {
    if (steering.yaw) tracker.turn_to(*steering.yaw);
    if (const auto* path = std::get_if<Path>(&steering.motion)) tracker.follow(*path);
    if (std::holds_alternative<Hold>(steering.motion)) tracker.hold();
    core.move(tracker, {.tick = input().tick, .state = state, .map = map, .boxes = boxes, .peers = peers});
    state.p_WB = tracker.commanded().p_WB;
    state.v_WB = tracker.commanded().v_WB;
    ++k;
  }
  FlightCore core{config, agent};
};

}  // namespace skein::agent
