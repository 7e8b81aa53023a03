// The recovery behaviours of a UAV that can reach none of its goals, and their order.
#include "uav_agent/flight_core/recovery.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

AgentConfig one_of(Role role) {
  AgentConfig agent;
  agent.fleet = {{.name = "a", .role = Role::explorer}};
  if (role == Role::photographer) {
    agent.fleet.push_back({.name = "b", .role = role, .p_WB_start = {50.0, 0.0, 0.0}, .body_radius_m = 0.32});
    agent.self = UavIndex(1);
  }
  return agent;
}

struct Recovers : FlownUav {
  explicit Recovers(Role role = Role::explorer) : FlownUav(one_of(role), {0.0, 0.0, 10.0}) {
    clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 24.0});
  }
  struct Try {
    double took_s = 0.0, moved_m = 0.0;
    int turns = 0;
  };
  /// One behaviour, up to its end.
  Try recover() {
    const std::uint64_t from = k;
    const Vector3d from_W = state.p_WB;
    Try result;
    navigator.update(input());
    recovery.update(input());
    recovery.begin(input(), {});
    for (bool over = false; !over && k < from + 4000;) {
      const PlannerInput in = input();
      navigator.update(in);
      Steering steering;
      over = recovery.step(in, filter.held(), steering);
      result.turns += steering.yaw.has_value();
      result.moved_m = std::max(result.moved_m, (state.p_WB - from_W).norm());
      fly(steering);
    }
    result.took_s = static_cast<double>(k - from) * agent.exchange_period_s;
    return result;
  }
  void fly_straight_to(const Vector3d& p_W) {
    tracker.follow({{{p_W, 3.0}}});
    for (int i = 0; i < 400; ++i) fly({});
    EXPECT_LT((state.p_WB - p_W).norm(), 0.5);
  }
  Recovery recovery{config, filter, navigator};
};

TEST(Recovery, LooksAroundFirst) {
  Recovers explorer, photographer(Role::photographer);
  const auto looks = explorer.recover();
  EXPECT_NEAR(looks.took_s, explorer.config.look_s, 0.2);
  EXPECT_GE(looks.turns, 4) << "it turns about its own axis";
  EXPECT_LT(looks.moved_m, 0.1);
  const auto waits = photographer.recover();
  EXPECT_EQ(waits.turns, 0) << "it has no LiDAR";
  EXPECT_LT(waits.moved_m, 0.1);
  EXPECT_LT(waits.took_s, looks.took_s);
}

TEST(Recovery, GoesElsewhereAfterLookingAround) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random(seed, "elsewhere", 0);
    const Vector3d missed_W(random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0), 60.0);
    Recovers uav;
    if (seed % 2 == 0) uav.navigator.want({{.id = 1, .way = {{missed_W, 3.0}}}});
    uav.navigate(20);
    Steering stop;
    uav.navigator.stop(stop);
    uav.navigator.take_outcomes();
    for (int i = 0; i < 60; ++i) uav.fly(stop);
    uav.recover();
    double moved_m = 0.0;
    for (int i = 0; i < 2; ++i) {
      uav.recovery.progress(uav.input());
      const auto tried = uav.recover();
      const bool anew = i == 0 && uav.recovery.doing() == Doing::What::looks_round;
      EXPECT_FALSE(anew) << "a goal reached right there is no progress";
      moved_m = std::max(moved_m, tried.moved_m);
      EXPECT_LT(tried.took_s, 40.0) << "each behaviour ends";
    }
    EXPECT_GT(moved_m, 4.0);
    uav.fly_straight_to({0.0, 0.0, 10.0});
    uav.recover();
    uav.fly_straight_to({4.0, 0.0, 10.0});
    uav.recovery.progress(uav.input());
    EXPECT_LT(uav.recover().moved_m, 0.5) << "the list begins anew";
  }
}

// A UAV that is walled in can go nowhere. Each behaviour ends all the same, and the UAV stays in proved space.
TEST(Recovery, EndsWhereThereIsNowhereToGo) {
  for (const Role role : {Role::explorer, Role::photographer}) {
    Recovers uav(role);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Vector3d low = Vector3d(-6.0, -6.0, 4.0), high = Vector3d(6.0, 6.0, 16.0);
        (sign > 0 ? low : high)[axis] = (sign > 0 ? high : low)[axis];
        uav.build(low, high);
      }
    }
    for (int i = 0; i < 8; ++i) {
      const auto tried = uav.recover();
      EXPECT_LT(tried.took_s, 40.0);
      EXPECT_TRUE(uav.filter.proved(uav.state.p_WB, uav.map, {}));
      EXPECT_LT((uav.state.p_WB - Vector3d(0.0, 0.0, 10.0)).cwiseAbs().maxCoeff(), 4.5);
    }
  }
}

/// Flies one recovery behaviour to its end. Calls `watch` after each exchange.
void recover_once(
    FlownUav& uav, Recovery& recovery, const std::function<void()>& watch = [] {}) {
  uav.navigator.update(uav.input());
  recovery.begin(uav.input(), {});
  for (bool over = false; !over;) {
    const PlannerInput in = uav.input();
    uav.navigator.update(in);
    recovery.update(in);
    Steering steering;
    over = recovery.step(in, uav.filter.held(), steering);
    uav.fly(steering);
    watch();
  }
}

// From the ground beside structure, a UAV would find no path any more.
TEST(Recovery, NoTrailLeadsBackToTheGround) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(seed, "ground", 0);
    FlownUav uav(one_of(seed % 2 == 0 ? Role::explorer : Role::photographer), {0.0, 0.0, 0.2});
    uav.lidar_works = false;
    const double top_m = random.uniform(4.5, 7.5);
    uav.clear({-4.0, -4.0, 0.0}, {4.0, 4.0, 12.0});
    uav.build({2.2, -2.0, 0.0}, {2.8, 2.0, 12.0});
    Recovery recovery{uav.config, uav.filter, uav.navigator};
    uav.tracker.follow({{{Vector3d(0.0, 0.0, top_m), 1.0}}});
    for (int i = 0; i < 200; ++i) {
      uav.navigator.update(uav.input());
      recovery.update(uav.input());
      uav.fly({});
    }
    ASSERT_NEAR(uav.state.p_WB.z(), top_m, 0.2) << "seed " << seed;
    double lowest_m = top_m;
    for (int tries = 0; tries < 10; ++tries) {
      recover_once(uav, recovery, [&] { lowest_m = std::min(lowest_m, uav.state.p_WB.z()); });
    }
    EXPECT_LT(lowest_m, 2.5) << "seed " << seed << ": it goes back";
    EXPECT_GT(lowest_m, 1.0) << "seed " << seed;
  }
}

// At the end of a shaft, no other space is known to be free. Each time that the UAV goes back, it goes farther.
TEST(Recovery, GoesBackTheWayThatItCame) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(seed, "back", 0);
    FlownUav uav(one_of(seed % 2 == 0 ? Role::explorer : Role::photographer), {0.0, 0.0, 6.0});
    uav.lidar_works = false;
    const double top_m = random.uniform(28.0, 50.0);
    uav.clear({-4.0, -4.0, 0.0}, {4.0, 4.0, top_m + 4.0});
    Recovery recovery{uav.config, uav.filter, uav.navigator};
    uav.navigator.want({{.id = 1, .way = {{Vector3d(0.0, 0.0, top_m), 3.0}}}});
    while (!uav.navigator.idle()) {
      recovery.update(uav.input());
      uav.navigate();
    }
    ASSERT_NEAR(uav.state.p_WB.z(), top_m, 0.2) << "seed " << seed;
    double lowest_m = top_m;
    for (int tries = 0; tries < 10; ++tries) {
      recover_once(uav, recovery);
      lowest_m = std::min(lowest_m, uav.state.p_WB.z());
      if (tries == 4) {
        EXPECT_LT(lowest_m, top_m - 7.0) << "seed " << seed;
      }
      EXPECT_TRUE(uav.filter.proved(uav.state.p_WB, uav.map, {}));
    }
    EXPECT_LT(lowest_m, top_m - 14.0) << "seed " << seed;
  }
}

// A shaft in which a neck is seen only after the UAV has flown through it: too narrow for kHaloM, and wide enough for a
// body that goes back slowly where it came. Half of the UAVs stand in the neck, the others above it.
struct ShutIn : Recovers {
  /// @param too_narrow  even for a body that goes back.
  ShutIn(Role role, std::uint64_t seed, bool too_narrow) : Recovers(role) {
    RandomStream random(seed, "shut_in", 0);
    lidar_works = false;
    const double neck_m = random.uniform(20.0, 24.0);
    // The map measures from cube to cube, so up to an edge of a cube is lost.
    const double least_m = filter.tube_m(config.tight_mps) - kHaloM + config.tight_halo_m + kCubeM;
    const double half_m = kCubeM * (too_narrow ? 1.0 : std::ceil(least_m / kCubeM));
    EXPECT_TRUE(too_narrow || half_m - kCubeM < filter.tube_m(0.0)) << "it is a neck";
    top_m = seed % 2 == 0 ? neck_m + 1.0 : neck_m + random.uniform(5.0, 8.0);
    low_m = neck_m - 3.0;
    map = WorldMap(WorldMap::Config{});
    clear({-6.0, -6.0, 0.0}, {6.0, 6.0, 40.0});
    navigator.want({{.id = 1, .way = {{Vector3d(0.0, 0.0, top_m), 3.0}}}});
    while (!navigator.idle()) {
      recovery.update(input());
      navigate();
    }
    for (const double sign : {-1.0, 1.0}) {
      for (int axis = 0; axis < 2; ++axis) {
        Vector3d low(-6.0, -6.0, neck_m), high(5.9, 5.9, neck_m + 2.0);
        (sign > 0 ? low : high)[axis] = sign * (half_m + 0.5 * kCubeM);
        build(low, high);
      }
    }
  }
  static constexpr double kCubeM = 0.5;
  double top_m = 0.0, low_m = 0.0;
};

TEST(Recovery, AUavShutInByStructureFliesBackAlongItsTrail) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    ShutIn uav(seed % 3 == 0 ? Role::photographer : Role::explorer, seed, false);
    ASSERT_NEAR(uav.state.p_WB.z(), uav.top_m, 0.2) << "seed " << seed;
    double least_m = 10.0;
    int tries = 0;
    for (; tries < 12 && uav.state.p_WB.z() > uav.low_m; ++tries) {
      recover_once(uav, uav.recovery,
                   [&] { least_m = std::min(least_m, uav.map.structure_distance_m(uav.state.p_WB)); });
    }
    EXPECT_LE(uav.state.p_WB.z(), uav.low_m) << "seed " << seed << ": it is out";
    EXPECT_LE(tries, 8) << "seed " << seed;
    EXPECT_GT(least_m, uav.agent.me().body_radius_m + uav.config.tight_halo_m) << "seed " << seed;
  }
}

// LiDARs of other UAVs may have taken this UAV for structure, all along the way that it came.
TEST(Recovery, AUavWhoseTrailIsMappedAsStructureGetsAwayFromIt) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "taken_for_structure", 0);
    Recovers uav(seed % 2 == 0 ? Role::explorer : Role::photographer);
    uav.lidar_works = false;
    const Vector3d to_W(random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0), random.uniform(15.0, 18.0));
    uav.navigator.want({{.id = 1, .way = {{to_W, 3.0}}}});
    std::vector<Vector3d> way_W;
    while (!uav.navigator.idle()) {
      uav.recovery.update(uav.input());
      uav.navigate();
      way_W.push_back(uav.state.p_WB);
    }
    const double near_m = random.uniform(0.5, 1.2);
    for (const Vector3d& p_W : way_W) {
      const double off_m = (p_W - uav.state.p_WB).norm();
      if (off_m > near_m && off_m < 3.0) uav.build(p_W, p_W);
    }
    const Vector3d from_W = uav.state.p_WB;
    for (int tries = 0; tries < 6; ++tries) uav.recover();
    EXPECT_GT((uav.state.p_WB - from_W).norm(), 0.9) << "seed " << seed;
    EXPECT_TRUE(uav.navigator.open_space(uav.input()).free(uav.state.p_WB)) << "seed " << seed;
  }
}

// If the neck is too narrow even for a body that goes back slowly, the UAV stays above it.
TEST(Recovery, NoUavGoesBackThroughLessThanItsBodyNeeds) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    ShutIn uav(seed % 2 == 0 ? Role::photographer : Role::explorer, 2 * seed + 1, true);
    for (int i = 0; i < 8; ++i) uav.recover();
    EXPECT_GT(uav.state.p_WB.z(), uav.low_m + 3.0) << "seed " << seed;
  }
}

// A UAV that has flown to and fro goes back to where it began, not through all its loops.
TEST(Recovery, ForgetsLoopsOfItsTrail) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(seed, "loops", 0);
    Recovers uav;
    uav.lidar_works = false;
    const Vector3d far_W(random.uniform(12.0, 18.0), 0.0, 10.0), aside_W(far_W.x(), random.uniform(8.0, 12.0), 10.0);
    std::int64_t id = 0;
    for (const Vector3d& p_W : {far_W, aside_W, far_W, aside_W, far_W}) {
      uav.navigator.want({{.id = ++id, .way = {{p_W, 4.0}}}});
      while (!uav.navigator.idle()) {
        uav.recovery.update(uav.input());
        uav.navigate();
      }
    }
    // All but the way that it came is unknown from now on.
    uav.map = WorldMap(WorldMap::Config{});
    uav.clear({-4.0, -4.0, 6.0}, {24.0, 4.0, 14.0});
    double farthest_y_m = 0.0;
    for (int i = 0; i < 12 && uav.state.p_WB.x() > far_W.x() - 7.0; ++i) {
      uav.recover();
      farthest_y_m = std::max(farthest_y_m, uav.state.p_WB.y());
    }
    EXPECT_LE(uav.state.p_WB.x(), far_W.x() - 7.0) << "seed " << seed;
    EXPECT_LT(farthest_y_m, 2.0) << "seed " << seed;
  }
}

TEST(Recovery, BringsTheUavNearerToTheGoalThatItMissed) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "approach", 0);
    Recovers uav;
    const Vector3d inside_W(15.0, random.uniform(-12.0, 12.0), random.uniform(5.0, 12.0));
    uav.build(inside_W - Vector3d::Constant(2.0), inside_W + Vector3d::Constant(2.0));
    uav.navigator.want({{.id = 1, .way = {{inside_W, 3.0}}}});
    uav.navigate(600);
    const double before_m = (uav.state.p_WB - inside_W).norm();
    uav.recover();
    uav.recover();
    EXPECT_LT((uav.state.p_WB - inside_W).norm(), before_m - 3.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skein::agent
