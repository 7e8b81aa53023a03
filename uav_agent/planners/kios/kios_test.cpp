// The KIOS planner in a world without physics: its two stages, its sharing, its weaknesses.
#include <gtest/gtest.h>

#include <set>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planners/kios/lanes.hpp"
#include "uav_agent/planners/kios/mapping.hpp"
#include "uav_agent/planners/kios/patience.hpp"
#include "uav_agent/planners/kios/talk.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

AgentConfig agent_of(std::size_t self, std::size_t explorers, std::size_t photographers) {
  AgentConfig agent;
  agent.self = UavIndex(self);
  for (std::size_t i = 0; i < explorers + photographers; ++i) {
    FleetMember member;
    member.name = "uav" + std::to_string(i);
    member.role = i < explorers ? Role::explorer : Role::photographer;
    member.p_WB_start = {4.0 * static_cast<double>(i), 0.0, 0.0};
    agent.fleet.push_back(member);
  }
  return agent;
}

const OrientedBox kMiddleBox = make_box({30.0, 10.0, 10.0}, {40.0, 4.0, 20.0});

/// 60 x 20 x 20 m, cubes of 5 m.
VoxelGrid long_volume() { return {Isometry3d::Identity(), {60.0, 20.0, 20.0}, 5.0}; }

TEST(KiosLanes, RunStraightAlongTheLongestAxisOnOppositeSides) {
  const auto first = mapping_lanes(agent_of(0, 2, 1), long_volume(), {kMiddleBox}, 0.0, 2);
  const auto second = mapping_lanes(agent_of(1, 2, 1), long_volume(), {kMiddleBox}, 0.0, 2);
  ASSERT_EQ(first.size(), 2U);
  ASSERT_EQ(second.size(), 2U);
  EXPECT_EQ((first[1] - first[0]).cwiseAbs(), Vector3d(20.0, 0.0, 0.0))
      << "the lane runs along the box, without its ends";
  EXPECT_EQ((second[1] - second[0]).cwiseAbs(), Vector3d(20.0, 0.0, 0.0));
  EXPECT_DOUBLE_EQ(std::abs(first[0].y() - second[0].y()), 15.0);
  const auto photographer = mapping_lanes(agent_of(2, 2, 1), long_volume(), {kMiddleBox}, 0.0, 2);
  EXPECT_TRUE(photographer.empty());
}

TEST(KiosLanes, StayNearTheStructureAndOutOfTheBoxes) {
  const VoxelGrid wide(Isometry3d::Identity(), {120.0, 100.0, 20.0}, 5.0);
  const OrientedBox box = make_box({60.0, 60.0, 10.0}, {90.0, 12.0, 20.0}, 0.1);
  const AgentConfig agent = agent_of(0, 1, 0);
  const auto lanes = mapping_lanes(agent, wide, {box}, 0.0, 2);
  ASSERT_EQ(lanes.size(), 4U);
  for (const Vector3d& p : lanes) EXPECT_LT(std::abs(p.y() - 60.0), 25.0);
  for (std::size_t i = 0; i < 4; i += 2) {
    for (double s = 0.0; s <= 1.0; s += 0.01) EXPECT_FALSE(box.contains(lanes[i] + s * (lanes[i + 1] - lanes[i]), 3.0));
  }
}

TEST(KiosLanes, ALoneExplorerFliesAllOfThemAndNoneTooLow) {
  const auto all = mapping_lanes(agent_of(0, 1, 0), long_volume(), {kMiddleBox}, 12.0, 2);
  ASSERT_EQ(all.size(), 4U);
  for (const Vector3d& p : all) EXPECT_GE(p.z(), 12.0);
  EXPECT_NE(all[0].y(), all[2].y());
}

/// A stand-in for the flight core: the test chooses the outcomes that the planner gets.
struct CoreOfTest {
  explicit CoreOfTest(AgentConfig of_agent) : agent(std::move(of_agent)) {
    config.world = &map;
    config.blind_fleet = !agent.first_explorer();
  }
  PlannerInput input(std::vector<Outcome> outcomes = {}) {
    ++k;
    RigidBodyState state;
    state.p_WB = p_W;
    TrackingState tracking;
    tracking.setpoint.p_WB = p_W;
    return {.k = k,
            .tick = static_cast<Tick>(k) * ticks(0.05),
            .state = state,
            .gimbal = {},
            .tracking = tracking,
            .map = hits,
            .boxes = boxes,
            .peers = peers,
            .mission_remaining_s = {},
            .detected = {},
            .radio = {},
            .world_map = &map,
            .flight = {.working = true, .outcomes = std::move(outcomes)},
            .space = &space.emplace(config, boxes, hits)};
  }

  AgentConfig agent;
  WorldMap map{WorldMap::Config()};
  OccupancyMap hits;
  std::vector<OrientedBox> boxes = {kMiddleBox};
  Peers peers{agent};
  FreeSpace::Config config;
  std::optional<FreeSpace> space;
  Vector3d p_W = {0.0, 0.0, 5.0};
  std::uint64_t k = 0;
};

TEST(KiosMapping, FliesLanesOneByOneAndGivesUpACornerThatItCannotReach) {
  CoreOfTest core(agent_of(0, 1, 0));
  KiosMapping mapping(3.0);
  const std::vector<Vector3d> corners = {Vector3d::UnitX(), 2.0 * Vector3d::UnitX(), 3.0 * Vector3d::UnitX(),
                                         4.0 * Vector3d::UnitX()};
  mapping.begin(corners);
  std::int64_t id = 0;
  const auto step = [&](std::vector<Outcome> outcomes) {
    PlannerOutput out;
    mapping.step(core.input(std::move(outcomes)), id, out);
    return out.goals ? out.goals->front().way : std::vector<Waypoint>();
  };
  const auto later = [&] {
    core.k += 40;
    return step({});
  };
  EXPECT_EQ(step({}).size(), 2U);
  EXPECT_TRUE(step({}).empty()) << "it is on its way";
  EXPECT_TRUE(step({{.id = id, .kind = Outcome::Kind::blocked, .leg = 1}}).empty());
  auto way = later();
  ASSERT_EQ(way.size(), 1U) << "to the end of the lane, whatever stands on it";
  EXPECT_EQ(way.front().p_WB, corners[1]);
  way = step({{.id = id, .kind = Outcome::Kind::reached}});
  ASSERT_EQ(way.size(), 2U);
  EXPECT_EQ(way.front().p_WB, corners[2]);
  for (int failure = 0; failure < 5; ++failure) {
    EXPECT_FALSE(way.empty());
    step({{.id = id, .kind = Outcome::Kind::no_way}});
    way = later();
  }
  ASSERT_EQ(way.size(), 1U) << "that corner is given up";
  EXPECT_EQ(way.front().p_WB, corners[3]);
  step({{.id = id, .kind = Outcome::Kind::reached}});
  EXPECT_TRUE(mapping.done());
}

/// The planner lists several goals. While it stops at one to look, the UAV must not go on to the next.
TEST(Kios, StaysAtAWaypointUntilItHasLooked) {
  CoreOfTest core(agent_of(0, 0, 1));
  const auto planner = make_planner("kios", core.agent);
  std::optional<std::vector<Goal>> goals;
  for (int i = 0; i < 10 && !(goals && !goals->empty()); ++i) goals = planner->plan(core.input()).goals;
  ASSERT_TRUE(goals);
  ASSERT_GT(goals->size(), 1U);
  core.p_W = goals->front().way.back().p_WB;
  const auto then = planner->plan(core.input({{.id = goals->front().id, .kind = Outcome::Kind::reached}})).goals;
  ASSERT_TRUE(then);
  EXPECT_TRUE(then->empty());
  std::optional<std::vector<Goal>> next;
  for (int i = 0; i < 80 && !next; ++i) next = planner->plan(core.input()).goals;
  ASSERT_TRUE(next);
  ASSERT_FALSE(next->empty());
  EXPECT_NE(next->front().way.back().p_WB, core.p_W);
}

TEST(Kios, FliesWhereCubesOfTheConfiguredSizeWouldBeTooMany) {
  CoreOfTest core(agent_of(0, 1, 0));
  core.boxes = {make_box({0.0, 0.0, 50.0}, {1200.0, 1000.0, 100.0})};
  const auto planner = make_planner("kios:voxel_m=1", core.agent);
  std::optional<std::vector<Goal>> goals;
  for (int i = 0; i < 10 && !(goals && !goals->empty()); ++i) goals = planner->plan(core.input()).goals;
  ASSERT_TRUE(goals);
  EXPECT_FALSE(goals->empty()) << "it flies its lanes";
}

TEST(KiosTalk, ClaimsTravelAndExpire) {
  const AgentConfig speaker = agent_of(0, 1, 1), listener = agent_of(1, 1, 1);
  VoxelGrid theirs = long_volume(), ours = long_volume();
  const OccupancyMap map;
  const Peers peers(speaker), other_peers(listener);
  const std::vector<OrientedBox> boxes;
  const auto input = [&](Tick tick, const Peers& seen, std::span<const RadioMessage> radio) {
    return PlannerInput{0, tick, {}, {}, {}, map, boxes, seen, {}, false, 0, {}, radio};
  };
  KiosTalk says({}, speaker), hears({}, listener);
  PlannerOutput out;
  KiosTalk::Word word;
  word.stop = 17;
  word.claims = {3, 4, 5};
  word.goal_W = {1.0, 2.0, 3.0};
  says.speak(input(0, peers, {}), theirs, word, out);
  ASSERT_EQ(out.radio.size(), 1U);
  hears.listen(input(400, other_peers, out.radio), ours);
  ASSERT_TRUE(hears.word(0));
  EXPECT_EQ(hears.word(0)->goal_W, word.goal_W);
  EXPECT_EQ(hears.claimed(500), (std::set<VoxelGrid::Id>{3, 4, 5}));
  EXPECT_TRUE(hears.taken(500).contains(17));
  EXPECT_TRUE(hears.claimed(400 + ticks(10.0)).empty());
}

TEST(KiosPatience, AUavThatComesBackStopsWaitingIfPhotographersWork) {
  const AgentConfig speaker = agent_of(1, 1, 2), listener = agent_of(2, 1, 2);
  VoxelGrid theirs = long_volume(), ours = long_volume();
  const OccupancyMap map;
  const Peers peers(listener);
  const std::vector<OrientedBox> boxes;
  const auto input = [&](std::span<const RadioMessage> radio, std::uint64_t k = 0) {
    return PlannerInput{k, ticks(60.0), {}, {}, {}, map, boxes, peers, {}, false, 0, {}, radio};
  };
  for (const bool works : {false, true}) {
    for (const bool came_back : {false, true}) {
      KiosTalk says({}, speaker), hears({}, listener);
      PlannerOutput out;
      KiosTalk::Word word;
      if (works) word.stop = 17;
      for (std::uint64_t k = 0; k < 100 && out.radio.empty(); ++k) says.speak(input({}, k), theirs, word, out);
      hears.listen(input(out.radio), ours);
      ASSERT_TRUE(hears.word(1));
      KiosPatience patience(listener, hears);
      patience.begin(ticks(60.0));
      if (came_back) patience.came_back();
      EXPECT_EQ(patience.is_over(input({}), KiosConfig{}.resolved()), works && came_back);
    }
  }
}

TEST(Kios, PhotographsTheStructureAndDeliversThePictures) {
  TestWorld world(two_towers(), test_fleet(3), "kios", 300.0);
  world.run(300.0);
  EXPECT_GT(world.coverage(), 0.7);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.5);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_LE(world.undelivered(), 6U) << "only captures of the last seconds are left";
}

TEST(Kios, PhotographersWaitUntilTheExplorersHaveFlownTheirLanes) {
  TestWorld world(two_towers(), test_fleet(3), "kios", 120.0);
  world.run(30.0);
  const Vector3d waits = world.position(1);
  EXPECT_LT((waits.head<2>() - Vector2d(-5.0, -14.0)).norm(), 0.5) << "it waits above its start";
  EXPECT_GT(waits.z(), 3.0);
  world.run(60.0);
  EXPECT_GT((world.position(1) - waits).norm(), 3.0);
}

// An explorer that has not flown all its lanes does not keep photographers waiting for longer than wait_s.
TEST(Kios, PhotographersWaitNoLongerThanConfigured) {
  TestWorld patient(two_towers(), test_fleet(3), "kios:map_mps=0.5", 120.0);
  TestWorld hasty(two_towers(), test_fleet(3), "kios:map_mps=0.5,wait_s=5", 120.0);
  patient.run(35.0);
  hasty.run(35.0);
  EXPECT_LT((patient.position(1).head<2>() - Vector2d(-5.0, -14.0)).norm(), 0.5) << "it waits above its start";
  EXPECT_GT((hasty.position(1) - patient.position(1)).norm(), 3.0);
}

TEST(Kios, WithoutMessagesTheStructureIsPhotographedAllTheSame) {
  TestScene scene = two_towers();
  scene.talk = false;
  TestWorld silent(scene, test_fleet(3), "kios", 300.0);
  silent.run(300.0);
  EXPECT_GT(silent.coverage(), 0.5);
}

TEST(Kios, WithoutALidarItLooksAtTheBoxes) {
  TestWorld world(two_towers(), {{"eye", Role::photographer, {-8.0, -14.0}}}, "kios", 250.0);
  world.run(250.0);
  EXPECT_GT(world.coverage(), 0.2);
  EXPECT_GT(world.clearance(), 0.32 + 0.5);
}

}  // namespace
}  // namespace skein::agent
