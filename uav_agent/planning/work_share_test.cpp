#include "uav_agent/planning/work_share.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

AgentConfig drawn_fleet(std::uint64_t seed, std::size_t explorers, std::size_t photographers) {
  RandomStream random(seed, "fleet", 0);
  AgentConfig agent;
  for (std::size_t i = 0; i < explorers + photographers; ++i) {
    FleetMember member;
    member.name = "uav" + std::to_string(i);
    member.role = i < explorers ? Role::explorer : Role::photographer;
    member.p_WB_start = {random.uniform(-30, 30), random.uniform(-30, 30), 0.0};
    agent.fleet.push_back(member);
  }
  std::swap(agent.fleet.front(), agent.fleet.back());  // explorers need not come first
  return agent;
}

std::vector<WorkShare> shares_of(AgentConfig agent, const std::vector<OrientedBox>& boxes) {
  std::vector<WorkShare> shares;
  for (const UavIndex i : FirstUavs(agent.fleet.size())) {
    agent.self = i;
    shares.push_back(team_share(agent, boxes, camera_reach({}, 2.0), 10.0, {}));
  }
  return shares;
}

TEST(TeamShare, EveryStripIsGivenExactlyOnce) {
  const std::pair<std::size_t, std::size_t> fleets[] = {{2, 3}, {1, 1}, {1, 4}, {3, 2}, {3, 0}, {0, 3}, {1, 0}};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const auto& [explorers, photographers] : fleets) {
      const std::vector<WorkShare> shares = shares_of(drawn_fleet(seed, explorers, photographers), two_towers().boxes);
      std::set<std::size_t> taken;
      std::size_t least = shares.front().tour.size(), most = least;
      for (const WorkShare& share : shares) {
        for (const Visit& visit : share.tour) EXPECT_TRUE(taken.insert(visit.strip).second);
        least = std::min(least, share.tour.size());
        most = std::max(most, share.tour.size());
      }
      EXPECT_EQ(taken.size(), shares.front().strips.size());
      EXPECT_LE(most, 2 * least + 4) << explorers << " explorers, " << photographers << " photographers";
    }
  }
}

/// A photographer may fly only where its explorer has been, so its strips lie beside those of an explorer.
TEST(TeamShare, NextToAPhotographersStripIsOneOfAnExplorer) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const AgentConfig agent = drawn_fleet(seed, 2, 3);
    const std::vector<WorkShare> shares = shares_of(agent, two_towers().boxes);
    const auto middle = [&](std::size_t strip) -> Vector3d {
      return 0.5 * (shares.front().strips[strip].begin_W + shares.front().strips[strip].end_W);
    };
    std::size_t beside = 0, all = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (agent.fleet[i].role == Role::explorer) continue;
      for (const Visit& visit : shares[i].tour) {
        double nearest_m = 1e9;
        for (std::size_t j = 0; j < shares.size(); ++j) {
          if (agent.fleet[j].role != Role::explorer) continue;
          for (const Visit& other : shares[j].tour) {
            nearest_m = std::min(nearest_m, (middle(visit.strip) - middle(other.strip)).norm());
          }
        }
        ++all;
        beside += nearest_m < 16.0;
      }
    }
    EXPECT_GE(10 * beside, 8 * all);
  }
}

}  // namespace
}  // namespace skein::agent
