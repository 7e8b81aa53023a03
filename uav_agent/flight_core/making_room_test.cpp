// Tests which UAVs make room, when, and where they go.
#include "uav_agent/flight_core/making_room.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

AgentConfig photographers_in_a_row(std::size_t count) {
  AgentConfig agent;
  for (std::size_t i = 0; i < count; ++i) {
    agent.fleet.push_back({.name = std::string(1, static_cast<char>('a' + i)),
                           .role = Role::photographer,
                           .p_WB_start = {4.0 * static_cast<double>(i), 0.0, 0.0},
                           .body_radius_m = 0.32});
  }
  return agent;
}

/// A UAV that rests 10 m above its start, in free space.
struct Rests : FlownUav {
  explicit Rests(std::size_t fleet) : FlownUav(photographers_in_a_row(fleet), {0.0, 0.0, 10.0}) {
    clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 24.0});
    fly({});  // the safety filter sees that there is room
  }
  double apart_m(std::size_t uav, const Vector3d& p_W) const { return filter.apart_m(uav, 0.0, state.p_WB - p_W); }
  /// Sees the others at some places for a time. @returns the first place to which it would make room.
  std::optional<Vector3d> see(const std::vector<Vector3d>& others_W, double for_s) {
    std::vector<Neighbour> neighbours;
    for (std::size_t i = 0; i < others_W.size(); ++i) {
      neighbours.push_back({node_of_uav(UavIndex(i + 1)), others_W[i], Vector3d(Vector3d::Zero())});
    }
    for (double t_s = 0.0; t_s < for_s; t_s += agent.exchange_period_s) {
      peers.update(input().tick, neighbours);
      making_room.update(input());
      if (const auto place_W = making_room.place_W(input())) return place_W;
      ++k;
    }
    return std::nullopt;
  }
  MakingRoom making_room{config, agent, filter};
};

Vector3d drawn_direction(RandomStream& random) {
  return Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)).normalized();
}

TEST(MakingRoom, IsForUavsThatStandCloseForLong) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "making_room_test", 0);
    Rests uav(2);
    const Vector3d along = drawn_direction(random);
    const double apart_m = uav.apart_m(1, uav.state.p_WB + along);
    const auto at = [&](double off_m) { return std::vector{Vector3d(uav.state.p_WB + along * off_m)}; };
    EXPECT_FALSE(uav.see(at(apart_m + 0.8), 60.0)) << "seed " << seed << ": it is far enough";
    EXPECT_FALSE(uav.see(at(apart_m + random.uniform(-0.3, 0.3)), 10.0)) << "seed " << seed << ": it may fly on";
    EXPECT_FALSE(uav.see({}, 60.0)) << "seed " << seed << ": it is out of sight";
    const auto place_W = uav.see(at(apart_m + random.uniform(-0.3, 0.3)), 20.0);
    ASSERT_TRUE(place_W) << "seed " << seed;
    EXPECT_GT((*place_W - at(apart_m).front()).norm(), apart_m + 0.5) << "seed " << seed;
    EXPECT_LT((*place_W - uav.state.p_WB).norm(), 3.1) << "seed " << seed;
  }
}

TEST(MakingRoom, LeadsAwayFromAllOthersAndNotToStructure) {
  int places = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "making_room_test", 1);
    Rests uav(4);
    uav.build({-1.9 - random.uniform(0.0, 1.0), -4.0, 8.0}, {-1.9, 4.0, 12.0});
    std::vector<Vector3d> others_W;
    const auto room_m = [&](const Vector3d& p_W) {
      double room_m = 10.0;
      for (std::size_t i = 0; i < others_W.size(); ++i) {
        room_m = std::min(room_m, (p_W - others_W[i]).norm() - uav.apart_m(i + 1, others_W[i]));
      }
      return room_m;
    };
    for (int i = 0; i < 3; ++i) others_W.push_back(uav.state.p_WB + drawn_direction(random) * random.uniform(1.3, 4.0));
    const auto place_W = uav.see(others_W, 40.0);
    if (!place_W) continue;
    ++places;
    EXPECT_GT(room_m(*place_W), room_m(uav.state.p_WB) + 0.3) << "seed " << seed;
    const double before_m = uav.map.structure_distance_m(uav.state.p_WB);
    uav.tracker.follow({{{*place_W, uav.config.tight_mps}}});
    for (int i = 0; i < 400; ++i) uav.fly({});
    EXPECT_LT((uav.state.p_WB - *place_W).norm(), 0.3) << "seed " << seed << ": the safety filter lets it go there";
    const double least_m = std::min(before_m, uav.filter.tube_m(0.0));
    EXPECT_GT(uav.map.structure_distance_m(uav.state.p_WB), least_m - 0.3) << "seed " << seed;
  }
  EXPECT_GT(places, 8);
}

TEST(MakingRoom, AUavThatDoesNotStandStillMakesNoRoom) {
  Rests uav(2);
  const Vector3d along = Vector3d::UnitX();
  const std::vector<Vector3d> beside_W = {uav.state.p_WB + (uav.apart_m(1, along + uav.state.p_WB) + 0.4) * along};
  for (int i = 0; i < 8; ++i) {
    const double to_m = i % 2 == 0 ? 1.0 : 0.0;
    uav.tracker.follow({{{Vector3d(0.0, to_m, 10.0), 1.0}}});
    for (int j = 0; j < 60; ++j) uav.fly({});
    EXPECT_NEAR(uav.state.p_WB.y(), to_m, 0.2);
    EXPECT_FALSE(uav.see(beside_W, 5.0));
  }
}

}  // namespace
}  // namespace skein::agent
