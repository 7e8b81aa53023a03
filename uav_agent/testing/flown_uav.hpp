// One UAV for tests of parts of the flight core, without a strategy and without physics: it is always exactly where it
// was commanded to be. The test sets the map, the peers and the link.
// Frame W.   Units: SI.
#pragma once

#include "uav_agent/flight_core/navigator.hpp"

namespace skein::agent {

struct FlownUav {
  FlownUav(AgentConfig of_agent, const Vector3d& at_W) : agent(std::move(of_agent)) {
    state.p_WB = at_W;
    tracker.follow({{{at_W, 1.0}}});  // airborne, and at rest
    for (int i = 0; i < 20; ++i) tracker.step(state, agent.exchange_period_s);
  }
  FlownUav(const FlownUav&) = delete;  // members refer to each other
  FlownUav& operator=(const FlownUav&) = delete;

  /// Makes space between two corners free, in cubes of 2 m.
  void clear(const Vector3d& low_W, const Vector3d& high_W) {
    const Eigen::Vector3i low = (0.5 * low_W).array().floor().cast<int>(),
                          high = (0.5 * high_W).array().ceil().cast<int>();
    for (int x = low.x(); x < high.x(); ++x) {
      for (int y = low.y(); y < high.y(); ++y) {
        for (int z = low.z(); z < high.z(); ++z) map.hear({x, y, z}, 2, Space::free, kOwn);
      }
    }
  }
  /// Makes all smallest cubes between two corners occupied.
  void build(const Vector3d& low_W, const Vector3d& high_W) {
    const WorldMap::Cube low = map.cube_of(low_W), high = map.cube_of(high_W);
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int z = low.z(); z <= high.z(); ++z) map.hear({x, y, z}, 0, Space::occupied, kOwn);
      }
    }
  }
  PlannerInput input() const {
    return {.k = k,
            .tick = static_cast<Tick>(k) * ticks(agent.exchange_period_s),
            .state = state,
            .gimbal = {},
            .tracking = tracker.tracking(),
            .map = hits,
            .boxes = boxes,
            .peers = peers,
            .mission_remaining_s = remaining_s,
            .station_linked = linked,
            .undelivered_captures = undelivered,
            .detected = {},
            .radio = {},
            .world_map = &map,
            .scanned = lidar_works};
  }
  /// Executes the steering of this exchange through tracker and safety filter, and moves the UAV on by one exchange.
  void fly(const Steering& steering) {
    if (steering.yaw) tracker.turn_to(*steering.yaw);
    if (const auto* path = std::get_if<Path>(&steering.motion)) tracker.follow(*path);
    if (std::holds_alternative<Hold>(steering.motion)) tracker.hold();
    const PlannerInput in = input();
    filter.step(tracker, {.tick = in.tick, .state = state, .map = map, .boxes = boxes, .peers = peers},
                navigator.pace_mps(), navigator.retraces());
    state.p_WB = tracker.commanded().p_WB;
    state.v_WB = tracker.commanded().v_WB;
    ++k;
  }
  /// Flies the navigator until it has no goals left, or for `most_exchanges`. @returns outcomes of its goals.
  std::vector<Outcome> navigate(int most_exchanges) {
    std::vector<Outcome> outcomes;
    for (int i = 0; i < most_exchanges && !navigator.idle(); ++i) {
      navigate();
      for (Outcome& outcome : navigator.take_outcomes()) outcomes.push_back(std::move(outcome));
    }
    return outcomes;
  }
  /// Flies the navigator for one exchange.
  void navigate() {
    const PlannerInput in = input();
    navigator.update(in);
    Steering steering;
    navigator.step(in, filter.held(), steering);
    fly(steering);
  }

  AgentConfig agent;
  FlightConfig config;
  WorldMap map{WorldMap::Config{}};
  OccupancyMap hits;
  std::vector<OrientedBox> boxes;
  Peers peers{agent};
  SafetyFilter filter{config, agent};
  Navigator navigator{config, agent, filter};
  Tracker tracker{Tracker::Config{.max_acceleration_mps2 = 2.8}};
  RigidBodyState state;
  std::uint64_t k = 0;
  std::optional<double> remaining_s;
  bool linked = false, lidar_works = true;
  std::size_t undelivered = 0;
};

}  // namespace skein::agent
