// STAR's teams, and how the boxes are shared among them.
#include "uav_agent/planners/star/teams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

FleetMember member(Role role, double x, double y = 0.0) {
  FleetMember uav;
  uav.role = role;
  uav.p_WB_start = {x, y, 0.0};
  return uav;
}

TEST(StarTeams, TeamsAreBalancedAndNearestPhotographersJoinFirst) {
  // Three photographers stand beside the first explorer: one of them has to go to the other.
  const std::vector<FleetMember> fleet = {member(Role::explorer, 0.0), member(Role::explorer, 50.0),
                                          member(Role::photographer, 3.0), member(Role::photographer, 1.0),
                                          member(Role::photographer, 2.0)};
  const auto teams = star_teams(fleet);
  ASSERT_EQ(teams.size(), 2U);
  EXPECT_EQ(teams[0].uavs, (std::vector<std::size_t>{0, 3, 4}));
  EXPECT_EQ(teams[1].uavs, (std::vector<std::size_t>{1, 2}));
}

TEST(StarTeams, EachUavIsInOneTeamWhateverTheFleet) {
  for (std::size_t explorers = 0; explorers < 5; ++explorers) {
    for (std::size_t photographers = 0; photographers < 6; ++photographers) {
      std::vector<FleetMember> fleet;
      for (std::size_t i = 0; i < explorers; ++i) fleet.push_back(member(Role::explorer, 7.0 * i));
      for (std::size_t i = 0; i < photographers; ++i) fleet.push_back(member(Role::photographer, 5.0 * i, 3.0));
      std::vector<std::size_t> all;
      for (const StarTeam& team : star_teams(fleet)) {
        all.insert(all.end(), team.uavs.begin(), team.uavs.end());
        if (explorers == 0) continue;
        EXPECT_LE(team.uavs.size() - 1, (photographers + explorers - 1) / explorers);
      }
      std::ranges::sort(all);
      ASSERT_EQ(all.size(), fleet.size());
      for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
    }
  }
}

TEST(StarTeams, ALargeBoxIsAsMuchWorkAsSeveralSmallOnes) {
  const std::vector<FleetMember> fleet = {member(Role::explorer, 0.0), member(Role::explorer, 10.0)};
  const std::vector<OrientedBox> boxes = {make_box({0, 40, 10}, {40, 40, 20}), make_box({60, 0, 5}, {8, 8, 10}),
                                          make_box({70, 0, 5}, {8, 8, 10}), make_box({80, 0, 5}, {8, 8, 10})};
  auto teams = star_teams(fleet);
  constexpr auto kLongest = FleetTourObjective::longest;
  share_boxes(fleet, boxes, {.volume_weight = 0.005, .objective = kLongest}, teams);
  const std::size_t has_large = std::ranges::count(teams[0].boxes, 0U) > 0 ? 0 : 1;
  EXPECT_EQ(teams[has_large].boxes, std::vector<std::size_t>{0}) << "the large one is work enough";
  EXPECT_EQ(teams[1 - has_large].boxes, (std::vector<std::size_t>{1, 2, 3}))
      << "in the order in which they are flown to";
  std::size_t shared = 0;
  share_boxes(fleet, boxes, {.volume_weight = 0.0, .objective = kLongest}, teams);
  for (const StarTeam& team : teams) shared += team.boxes.size();
  EXPECT_EQ(shared, boxes.size());
}

/// The boxes stand in a row. Both teams together fly least if one of them takes all boxes but one, however much work
/// that is. The longest tour is shortest if they share.
TEST(StarTeams, AllTeamsTogetherFlyLeastWhateverTheVolumes) {
  std::size_t fewest = 0;  // boxes of a team when the longest tour counts, over all cases
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "boxes", 0);
    const std::vector<FleetMember> fleet = {member(Role::explorer, 0.0), member(Role::explorer, -4.0)};
    std::vector<OrientedBox> boxes;
    for (int i = 0; i < 5; ++i) {
      boxes.push_back(make_box({20.0 + 15.0 * i + random.uniform(-3.0, 3.0), 0.0, 10.0}, {8.0, 8.0, 10.0}));
      boxes.back().size.z() = random.uniform(5.0, 40.0);
    }
    auto teams = star_teams(fleet);
    share_boxes(fleet, boxes, {}, teams);
    std::multiset<std::size_t> sizes = {teams[0].boxes.size(), teams[1].boxes.size()};
    EXPECT_EQ(sizes, (std::multiset<std::size_t>{1, 4})) << "seed " << seed;
    share_boxes(fleet, boxes, {.objective = FleetTourObjective::longest}, teams);
    fewest += std::min(teams[0].boxes.size(), teams[1].boxes.size());
  }
  EXPECT_GT(fewest, 30U) << "two of five in most cases";
}

TEST(StarTeams, EachTeamHasABoxWhereThereAreEnough) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "teams", 0);
    std::vector<FleetMember> fleet;
    std::vector<OrientedBox> boxes;
    const int explorers = 1 + static_cast<int>(random.uniform(0.0, 4.0));
    for (int i = 0; i < explorers; ++i) fleet.push_back(member(Role::explorer, random.uniform(-40.0, 40.0), 5.0 * i));
    for (int i = 0; i < explorers + static_cast<int>(random.uniform(0.0, 5.0)); ++i) {
      boxes.push_back(make_box({random.uniform(-90.0, 90.0), random.uniform(-90.0, 90.0), 10.0}, {8.0, 9.0, 20.0}));
    }
    auto teams = star_teams(fleet);
    share_boxes(fleet, boxes, {}, teams);
    std::vector<std::size_t> all, each(boxes.size());
    std::iota(each.begin(), each.end(), std::size_t{0});
    for (const StarTeam& team : teams) {
      EXPECT_FALSE(team.boxes.empty()) << "seed " << seed;
      all.insert(all.end(), team.boxes.begin(), team.boxes.end());
    }
    std::ranges::sort(all);
    EXPECT_EQ(all, each) << "seed " << seed << ": a box is with no team, or with two";
  }
}

TEST(StarTeams, ATeamWithoutABoxHelpsUnlessItIsFaithful) {
  const std::vector<FleetMember> fleet = {member(Role::explorer, 0.0), member(Role::explorer, 90.0)};
  const std::vector<OrientedBox> boxes = {make_box({5, 0, 10}, {10, 10, 20})};
  for (const std::size_t self : {0U, 1U}) {
    EXPECT_EQ(own_team(fleet, self, boxes, {}, true).boxes, std::vector<std::size_t>{0});
  }
  EXPECT_EQ(own_team(fleet, 0, boxes, {}, false).boxes.size() + own_team(fleet, 1, boxes, {}, false).boxes.size(), 1U);
}

}  // namespace
}  // namespace skein::agent
