// UAVs for tests of the safety filter. They fly with a real tracker, and are where they were commanded to be, plus a
// random error if the test calls drift().
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <vector>

#include "core/math/random_stream.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

inline constexpr double kPeriodS = 0.05, kBodyM = 0.63;

inline Tracker::Config vehicle_limits() {
  return {.max_speed_mps = 6.0, .max_acceleration_mps2 = 2.8, .max_yaw_rate = 0.8};
}

inline AgentConfig fleet_of(std::size_t uavs, Role role, std::size_t self) {
  AgentConfig agent;
  for (std::size_t i = 0; i < uavs; ++i) {
    const Vector3d start_W(100.0, 3.0 * static_cast<double>(i), 0.0);
    agent.fleet.push_back({.name = "uav" + std::to_string(i), .role = role, .p_WB_start = start_W});
  }
  agent.self = UavIndex(self);
  return agent;
}

inline Vector3d drawn_within(RandomStream& random, double radius_m) {
  Vector3d p;
  do {
    for (int i = 0; i < 3; ++i) p[i] = random.uniform(-radius_m, radius_m);
  } while (p.norm() > radius_m);
  return p;
}

inline Vector3d drawn_in(RandomStream& random, const Vector3d& low, const Vector3d& high) {
  return {random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()), random.uniform(low.z(), high.z())};
}

/// One UAV whose motion the safety filter limits.
struct GuardedUav {
  explicit GuardedUav(const Vector3d& start_W, AgentConfig config = fleet_of(1, Role::explorer, 0))
      : agent(std::move(config)), peers(agent) {
    state.p_WB = start_W;
  }
  void fly(std::vector<Waypoint> way) { tracker.follow({std::move(way)}); }
  void step(double most_mps = 100.0) {
    filter.step(tracker, {.tick = tick, .state = state, .map = map, .boxes = boxes, .peers = peers}, most_mps);
    tick += ticks(kPeriodS);
    state.p_WB = tracker.commanded().p_WB;
    state.v_WB = tracker.commanded().v_WB;
  }
  void drift(RandomStream& random) {
    state.p_WB += drawn_within(random, config.error_m + config.error_per_mps_s * state.v_WB.norm());
  }
  /// Positions on the braking trajectory from the last command to rest: a copy of the tracker flies it step by step.
  std::vector<Vector3d> braking_way() const {
    Tracker brakes = tracker;
    RigidBodyState follows;
    follows.p_WB = brakes.commanded().p_WB;
    std::vector<Vector3d> way = {follows.p_WB};
    brakes.hold();
    do {
      follows.p_WB = brakes.step(follows, kPeriodS)->p_WB;
      way.push_back(follows.p_WB);
    } while (brakes.commanded().v_WB.norm() > 1e-9);
    return way;
  }
  /// Smallest cubes near p that are not free.
  std::vector<WorldMap::Cube> not_free_about(const Vector3d& p_W, double radius_m) const {
    std::vector<WorldMap::Cube> cubes;
    map.not_free_near(p_W, radius_m, config.ground_m, cubes);
    return cubes;
  }
  /// Distance of a cube from the nearest of these places [m].
  double off_m(const WorldMap::Cube& cube, const std::vector<Vector3d>& places_W) const {
    double off = 1e9;
    for (const Vector3d& p_W : places_W) off = std::min(off, map.distance_to_m(cube, p_W));
    return off;
  }

  FlightConfig config;
  AgentConfig agent;
  WorldMap map{WorldMap::Config{}};
  std::vector<OrientedBox> boxes;
  Peers peers;
  SafetyFilter filter{config, agent};
  Tracker tracker{vehicle_limits()};
  RigidBodyState state;
  Tick tick = 0;
};

/// Makes overlapping balls free, as a LiDAR would, along a random walk from at_W; then makes some cubes near its end
/// occupied.
inline void carve(RandomStream& random, int balls, int cubes, WorldMap& map, Vector3d at_W) {
  for (int i = 0; i < balls; ++i) {
    map.set_free(at_W, random.uniform(2.5, 5.0));
    at_W += drawn_within(random, 3.5);
    at_W.z() = std::clamp(at_W.z(), 1.5, 20.0);
  }
  for (int i = 0; i < cubes; ++i) map.hear(map.cube_of(at_W + drawn_within(random, 8.0)), 0, Space::occupied, kOwn);
}

inline std::vector<Waypoint> drawn_way(RandomStream& random, const Vector3d& about_W) {
  std::vector<Waypoint> way;
  for (std::uint64_t i = random.bits() % 4 + 1; i > 0; --i) {
    Vector3d p_W = about_W + drawn_within(random, 12.0);
    p_W.z() = std::max(0.5, p_W.z());
    way.push_back({p_W, random.uniform(0.5, 6.0)});
  }
  return way;
}

/// Two explorers in a large free space. While in sight, each knows the other's state of `latency` exchanges ago. Their
/// bodies are where they were commanded to be `late` exchanges ago.
class TwoGuardedUavs {
 public:
  TwoGuardedUavs(RandomStream& random, int latency, std::size_t late = 0) : latency_(latency), late_(late) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector3d start_W(i == 0 ? -6.0 : 6.0, random.uniform(-6.0, 6.0), random.uniform(8.0, 14.0));
      uavs.push_back(std::make_unique<GuardedUav>(start_W, fleet_of(2, Role::explorer, i)));
      for (int x = -16; x < 16; ++x) {
        for (int y = -16; y < 16; ++y) {
          for (int z = 0; z < 16; ++z) uavs[i]->map.hear({x, y, z}, 2, Space::free, kOwn);
        }
      }
    }
  }
  void step(bool in_sight, RandomStream& random) {
    past_.push_back({uavs[0]->state, uavs[1]->state});
    const auto& told = past_[past_.size() - 1 - std::min(past_.size() - 1, static_cast<std::size_t>(latency_))];
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<Neighbour> neighbours;
      const RigidBodyState& other = told[1 - i];
      if (in_sight) neighbours.push_back({node_of_uav(UavIndex(1 - i)), other.p_WB, other.v_WB});
      uavs[i]->peers.update(uavs[i]->tick, neighbours);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      uavs[i]->step();
      commanded_[i].push_back(uavs[i]->state);
      if (commanded_[i].size() > late_ + 1) commanded_[i].pop_front();
      uavs[i]->state = commanded_[i].front();
    }
    for (auto& uav : uavs) uav->drift(random);
  }
  double apart_m() const { return (uavs[0]->state.p_WB - uavs[1]->state.p_WB).norm(); }

  std::vector<std::unique_ptr<GuardedUav>> uavs;

 private:
  int latency_;
  std::size_t late_;
  std::vector<std::array<RigidBodyState, 2>> past_;
  std::array<std::deque<RigidBodyState>, 2> commanded_;
};

}  // namespace skein::agent
