// What must hold of whatever the safety filter lets through, over drawn maps, paths, speeds and other UAVs. UAVs fly
// through a real tracker, and are where they were commanded to be but for a drawn error.
#include "uav_agent/flight_core/safety_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr double kPeriodS = 0.05;
/// A way is looked at in steps of 0.3 m, so between them a tube is that much narrower; and as much for rounding.
constexpr double kBetweenStepsM = 0.01;
/// By so much what it flies away from may lie within the tube of its speed: measured, 0.035 m.
constexpr double kFliesAwayM = 0.05;
constexpr double kBodyM = 0.63;

Tracker::Config vehicle_limits() { return {.max_speed_mps = 6.0, .max_acceleration_mps2 = 2.8, .max_yaw_rate = 0.8}; }

AgentConfig fleet_of(std::size_t uavs, Role role, std::size_t self) {
  AgentConfig agent;
  for (std::size_t i = 0; i < uavs; ++i) {
    const Vector3d start_W(100.0, 3.0 * static_cast<double>(i), 0.0);
    agent.fleet.push_back({.name = "uav" + std::to_string(i), .role = role, .p_WB_start = start_W});
  }
  agent.self = UavIndex(self);
  return agent;
}

Vector3d drawn_within(RandomStream& random, double radius_m) {
  Vector3d p;
  do {
    for (int i = 0; i < 3; ++i) p[i] = random.uniform(-radius_m, radius_m);
  } while (p.norm() > radius_m);
  return p;
}

Vector3d drawn_in(RandomStream& random, const Vector3d& low, const Vector3d& high) {
  return {random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()), random.uniform(low.z(), high.z())};
}

/// One UAV under its filter, for whoever wants to see where it is let.
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
  /// Up to rest, from what it was commanded last; flown, not foretold.
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
  std::vector<WorldMap::Cube> not_free_about(const Vector3d& p_W, double radius_m) const {
    std::vector<WorldMap::Cube> cubes;
    map.not_free_near(p_W, radius_m, config.ground_m, cubes);
    return cubes;
  }
  /// From the nearest of these places.
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

/// Free balls one beside the other, as a LiDAR carves them out of the unknown, with some structure in between.
void carve(RandomStream& random, int balls, int cubes, WorldMap& map, Vector3d at_W) {
  for (int i = 0; i < balls; ++i) {
    map.set_free(at_W, random.uniform(2.5, 5.0));
    at_W += drawn_within(random, 3.5);
    at_W.z() = std::clamp(at_W.z(), 1.5, 20.0);
  }
  for (int i = 0; i < cubes; ++i) map.hear(map.cube_of(at_W + drawn_within(random, 8.0)), 0, Space::occupied, kOwn);
}

std::vector<Waypoint> drawn_way(RandomStream& random, const Vector3d& about_W) {
  std::vector<Waypoint> way;
  for (std::uint64_t i = random.bits() % 4 + 1; i > 0; --i) {
    Vector3d p_W = about_W + drawn_within(random, 12.0);
    p_W.z() = std::max(0.5, p_W.z());
    way.push_back({p_W, random.uniform(0.5, 6.0)});
  }
  return way;
}

// However it is told to fly, and as long as the map only grows freer: what is all about its braking way is free. Its
// tube widens as it gets faster, so what it flies away from may lie in it for a while (kFliesAwayM).
TEST(SafetyFilter, CouldBrakeInFreeSpaceAtAnyTime) {
  double flown_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "free_space", 0);
    const Vector3d start_W(0.0, 0.0, random.uniform(0.2, 12.0));
    GuardedUav uav(start_W);
    uav.map.set_free(start_W, 3.0);
    carve(random, 8, static_cast<int>(random.bits() % 6), uav.map, start_W);
    uav.map.set_free(start_W, 3.0);
    if (!uav.filter.proved(start_W, uav.map, {})) continue;  // structure was drawn there
    for (int k = 0; k < 400; ++k) {
      if (k % 60 == 0) uav.fly(drawn_way(random, uav.tracker.commanded().p_WB));
      if (k % 20 == 0) uav.map.set_free(uav.state.p_WB + drawn_within(random, 6.0), random.uniform(1.0, 4.0));
      const Vector3d before_W = uav.tracker.moves() ? uav.tracker.commanded().p_WB : start_W;
      uav.step(random.uniform() < 0.1 ? random.uniform(0.2, 6.0) : 100.0);
      flown_m += (uav.state.p_WB - before_W).norm();
      const double radius_m = uav.filter.tube_m(uav.state.v_WB.norm()) - kBetweenStepsM;
      for (const Vector3d& p_W : uav.braking_way()) {
        for (const auto& cube : uav.not_free_about(p_W, radius_m)) {
          ASSERT_GT(uav.off_m(cube, {p_W}), uav.off_m(cube, {before_W}) - 1e-5) << "seed " << seed << " k " << k;
        }
      }
      uav.drift(random);
      ASSERT_TRUE(uav.not_free_about(uav.state.p_WB, kBodyM + kHaloM - kFliesAwayM).empty());
    }
  }
  EXPECT_GT(flown_m, 1000.0) << "without flying, it is no merit";
}

// Something is seen within what it could brake in. Nothing can be done about the way to rest, but all else.
TEST(SafetyFilter, WhatAppearsAheadIsNotApproachedAnyFurther) {
  int broken = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    RandomStream random(seed, "appears", 0);
    GuardedUav uav({0.0, 0.0, 10.0});
    uav.config.tight_halo_m = kHaloM;
    uav.map.set_free({0.0, 0.0, 10.0}, 12.0);
    uav.fly({{drawn_within(random, 30.0) + Vector3d(0.0, 0.0, 30.0), random.uniform(1.0, 6.0)}});
    const int until = 5 + static_cast<int>(random.bits() % 40);
    for (int k = 0; k < until; ++k) uav.step();
    std::vector<Vector3d> rest_of_way = uav.braking_way();
    std::vector<WorldMap::Cube> seen;
    for (int i = 0; i < 3; ++i) {
      const Vector3d about_W = rest_of_way[random.bits() % rest_of_way.size()];
      seen.push_back(uav.map.cube_of(about_W + drawn_within(random, 2.5)));
      uav.map.hear(seen.back(), 0, Space::occupied, kOwn);
    }
    const double radius_m = uav.filter.tube_m(0.0);
    std::vector<double> least_m;
    for (const auto& cube : seen) least_m.push_back(std::min(radius_m, uav.off_m(cube, rest_of_way)));
    const std::uint64_t before = uav.filter.counts().slowed;
    for (int k = 0; k < 300; ++k) {
      if (k % 25 == 0) uav.fly(drawn_way(random, uav.map.cube_of(uav.state.p_WB).cast<double>() * 0.5));
      uav.drift(random);
      uav.step();
      for (std::size_t i = 0; i < seen.size(); ++i) {
        ASSERT_GT(uav.off_m(seen[i], {uav.tracker.commanded().p_WB}), least_m[i] - kBetweenStepsM)
            << "seed " << seed << " k " << k;
      }
    }
    broken += uav.filter.counts().slowed > before;
  }
  EXPECT_GT(broken, 40) << "nothing stood in the way";
}

// It is where too little is known, and is told again and again to fly off. Its place is not what is measured:
// that swings, and each swing forward would be a licence to follow it.
TEST(SafetyFilter, DoesNotCreepIntoTheUnknown) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "creeps", 0);
    const Vector3d ahead_W = drawn_within(random, 1.0).normalized();
    const double free_m = seed % 2 == 0 ? random.uniform(0.8, 1.6) : 8.0;  // little all about it, or ahead alone
    GuardedUav uav(Vector3d(0.0, 0.0, 20.0) + (free_m > 2.0 ? free_m - 1.2 : 0.0) * ahead_W);
    uav.config.tight_halo_m = kHaloM;  // as for one that has had room before
    uav.map.set_free({0.0, 0.0, 20.0}, free_m);
    const Vector3d goal_W = uav.state.p_WB + 20.0 * ahead_W;
    uav.fly({{goal_W, 5.0}});
    uav.step();
    const Vector3d first_W = uav.tracker.commanded().p_WB;
    const auto unknown = uav.not_free_about(first_W, uav.filter.tube_m(0.0));
    ASSERT_FALSE(unknown.empty());
    for (int k = 0; k < 1000; ++k) {
      if (k % 10 == 0) uav.fly({{goal_W, random.uniform(0.5, 6.0)}});
      uav.drift(random);
      uav.step();
      for (const auto& cube : unknown) {
        ASSERT_GT(uav.off_m(cube, {uav.tracker.commanded().p_WB}), uav.off_m(cube, {first_W}) - 0.005)
            << "seed " << seed << " k " << k;
      }
    }
  }
}

// Put down beside what leaves it less room than the halo, it leaves, slowly and with less; once it has had room, the
// halo is kept again.
TEST(SafetyFilter, LeavesAPlaceWithLittleRoomSlowly) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "tight", 0);
    GuardedUav uav({0.0, 0.0, 10.0});
    uav.map.set_free({0.0, 0.0, 10.0}, 14.0);
    const double angle = random.uniform(-3.0, 3.0), off_m = random.uniform(1.55, 1.8);
    std::vector<WorldMap::Cube> pole;
    for (double z = 6.0; z < 30.0; z += 0.5) {
      pole.push_back(uav.map.cube_of({off_m * std::cos(angle), off_m * std::sin(angle), z}));
      uav.map.hear(pole.back(), 0, Space::occupied, kOwn);
    }
    const double tight_m = std::min(uav.off_m(pole[8], {uav.state.p_WB}), kBodyM + uav.config.error_m);
    const Vector3d away_W(-std::cos(angle), -std::sin(angle), 0.0);
    uav.fly({{Vector3d(0.0, 0.0, 11.0) + 6.0 * away_W, 3.0}, {{0.0, 0.0, 14.0}, 3.0}});
    bool had_room = false;
    for (int k = 0; k < 600; ++k) {
      uav.step();
      const Vector3d here_W = uav.tracker.commanded().p_WB;
      double nearest_m = 1e9;
      for (const auto& cube : pole) nearest_m = std::min(nearest_m, uav.off_m(cube, {here_W}));
      had_room = had_room || nearest_m > uav.filter.tube_m(0.0);
      ASSERT_GT(nearest_m, had_room ? uav.filter.tube_m(0.0) - kFliesAwayM : tight_m - kBetweenStepsM) << seed;
      if (!had_room) {
        ASSERT_LT(uav.tracker.commanded().v_WB.norm(), uav.config.tight_mps + 0.05);
      }
    }
    EXPECT_TRUE(had_room) << "seed " << seed;
  }
}

/// Two explorers in wide free space that know of each other what was true some exchanges ago.
class TwoGuardedUavs {
 public:
  TwoGuardedUavs(RandomStream& random, int latency) : latency_(latency) {
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
    for (auto& uav : uavs) uav->step();
    for (auto& uav : uavs) uav->drift(random);
  }
  double apart_m() const { return (uavs[0]->state.p_WB - uavs[1]->state.p_WB).norm(); }

  std::vector<std::unique_ptr<GuardedUav>> uavs;

 private:
  int latency_;
  std::vector<std::array<RigidBodyState, 2>> past_;
};

// Both want to be where the other one is, or across its way.
TEST(SafetyFilter, TwoUavsNeverTouch) {
  double nearest_m = 1e9;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    RandomStream random(seed, "two_uavs", 0);
    TwoGuardedUavs two(random, static_cast<int>(seed % 2));
    for (int k = 0; k < 400; ++k) {
      if (k % 80 == 0) {
        const Vector3d meet_W = drawn_in(random, {-4.0, -4.0, 8.0}, {4.0, 4.0, 14.0});
        for (auto& uav : two.uavs) {
          const Vector3d beyond_W = meet_W + (meet_W - uav->state.p_WB) + drawn_within(random, 3.0);
          uav->fly(
              {{meet_W + drawn_within(random, 1.0), random.uniform(0.5, 6.0)}, {beyond_W, random.uniform(0.5, 6.0)}});
        }
      }
      two.step(true, random);
      nearest_m = std::min(nearest_m, two.apart_m());
      ASSERT_GT(two.apart_m(), 2.0 * kBodyM) << "seed " << seed << " k " << k;
    }
  }
  EXPECT_LT(nearest_m, 3.0) << "they never met";
}

// One goes out of sight, and comes to rest there: the other one keeps off, though it hears no more of it.
TEST(SafetyFilter, KeepsOffAUavThatWentOutOfSight) {
  double nearest_m = 1e9;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "out_of_sight", 0);
    TwoGuardedUavs two(random, static_cast<int>(seed % 2));
    const std::size_t rests = random.bits() % 2;
    const int lost = 10 + static_cast<int>(random.bits() % 60);
    GuardedUav &still = *two.uavs[rests], &other = *two.uavs[1 - rests];
    still.fly(drawn_way(random, still.state.p_WB));
    for (int k = 0; k < lost + 300; ++k) {
      if (k == lost) still.tracker.hold();
      if (k % 60 == 0) other.fly({{2.0 * still.state.p_WB - other.state.p_WB, random.uniform(1.0, 6.0)}});
      two.step(k < lost, random);
      nearest_m = std::min(nearest_m, two.apart_m());
      ASSERT_GT(two.apart_m(), 2.0 * kBodyM) << "seed " << seed << " k " << k;
    }
  }
  EXPECT_LT(nearest_m, 3.0) << "they never met";
}

// Nobody has a LiDAR: boxes are all that is known, and nobody flies into one.
TEST(SafetyFilter, ABlindFleetKeepsOutOfBoxes) {
  double flown_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "blind", 0);
    GuardedUav uav({0.0, 0.0, 10.0}, fleet_of(1, Role::photographer, 0));
    for (int i = 0; i < 12; ++i) {
      OrientedBox box;
      box.center = drawn_in(random, {-15.0, -15.0, 0.0}, {15.0, 15.0, 20.0});
      box.size = drawn_in(random, {1.0, 1.0, 1.0}, {8.0, 8.0, 8.0});
      box.R_WO = Eigen::AngleAxisd(random.uniform(0.0, 3.0), Vector3d::UnitZ()).toRotationMatrix();
      if (!box.contains(uav.state.p_WB, 2.5)) uav.boxes.push_back(box);
    }
    const Vector3d start_W = uav.state.p_WB;
    for (int k = 0; k < 400; ++k) {
      if (k % 80 == 0) uav.fly(drawn_way(random, uav.state.p_WB));
      uav.step();
      uav.drift(random);
      for (const OrientedBox& box : uav.boxes) ASSERT_FALSE(box.contains(uav.state.p_WB, kBodyM)) << "seed " << seed;
    }
    flown_m += (uav.state.p_WB - start_W).norm();
  }
  EXPECT_GT(flown_m, 300.0);
}

// Nearer to a box than it may be, by a hair or by much: it comes no nearer, and it is not bound to stay there for ever.
TEST(SafetyFilter, ABlindUavMayLeaveABoxThatItIsTooNearTo) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "leaves", 0);
    GuardedUav uav({0.0, 0.0, 10.0}, fleet_of(1, Role::photographer, 0));
    OrientedBox box;
    box.size = {4.0, 4.0, 20.0};
    const double off_m = uav.filter.tube_m(0.0) - (seed % 2 == 0 ? 1e-3 : random.uniform(0.01, 0.8));
    box.center = {2.0 + off_m, 0.0, 10.0};
    uav.boxes = {box};
    uav.fly({{{6.0, random.uniform(-1.0, 1.0), 10.0}, 3.0}});
    for (int k = 0; k < 100; ++k) uav.step();
    ASSERT_LT(uav.tracker.commanded().p_WB.x(), 1e-3) << "seed " << seed;
    uav.fly({{{-6.0, random.uniform(-3.0, 3.0), 10.0}, 3.0}});
    for (int k = 0; k < 200; ++k) uav.step();
    ASSERT_LT(uav.state.p_WB.x(), -5.9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skein::agent
