// The XXH planner: what its UAVs tell each other, and flights in a world without physics.
#include <gtest/gtest.h>

#include "uav_agent/planners/xxh/talk.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

TEST(XxhTalk, WordsAreReadAsTheyWereWritten) {
  XxhWord word;
  word.start_W = {1.0, -2.0, 0.25};
  word.has_plan = word.done = true;
  word.region = 7;
  word.explored = 3;
  word.from_high_end = word.decided = true;
  word.way_W = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  PayloadWriter writer;
  write_word(word, writer);
  PayloadReader reader(writer.data());
  const auto heard = read_word(reader);
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->start_W, word.start_W);
  EXPECT_TRUE(heard->has_plan && heard->done && !heard->acknowledged);
  EXPECT_TRUE(heard->from_high_end && heard->decided);
  EXPECT_EQ(heard->region, 7);
  EXPECT_EQ(heard->explored, 3);
  EXPECT_EQ(heard->way_W, word.way_W);
  for (std::size_t length = 0; length < writer.size(); ++length) {
    PayloadReader cut(std::span(writer.data()).first(length));
    EXPECT_FALSE(read_word(cut));
  }
}

/// The first and the last UAV of a fleet announce where they will fly. @returns of how many of these two the UAV `self`
/// keeps clear.
std::size_t keeps_clear_of(std::size_t self, double after_s, bool forever) {
  AgentConfig agent;
  agent.self = UavIndex(self);
  for (const TestUav& uav : test_fleet(4)) agent.fleet.push_back({uav.name, uav.role, {0.0, 0.0, 0.0}, 0.5});
  XxhTalk talk({.claim_s = forever ? kNeverS : 3.0, .all_give_way = forever}, agent);
  const OccupancyMap map;
  const Peers peers(agent);
  const std::vector<OrientedBox> boxes;
  std::vector<RadioMessage> radio;
  for (const std::size_t uav : {0, 3}) {
    XxhWord word;
    word.way_W = {{20.0 + 30.0 * static_cast<double>(uav), 0.0, 10.0}};
    PayloadWriter writer;
    write_word(word, writer);
    radio.push_back(send_payload("xxh/1", uav, writer));
  }
  talk.listen({0, 0, {}, {}, {}, map, boxes, peers, {}, false, 0, {}, radio}, nullptr);
  return talk.trajectories({0, ticks(after_s), {}, {}, {}, map, boxes, peers, {}, false, 0, {}, {}}).size();
}

TEST(XxhTalk, AUavThatHasLessPriorityKeepsClearOfTheOthersTrajectoriesForAWhile) {
  EXPECT_EQ(keeps_clear_of(1, 1.0, false), 1U) << "a photographer: of the explorer, not of the photographer behind it";
  EXPECT_EQ(keeps_clear_of(2, 1.0, false), 1U) << "the second explorer: of the first, not of any photographer";
  EXPECT_EQ(keeps_clear_of(1, 60.0, false), 0U);
  EXPECT_EQ(keeps_clear_of(1, 60.0, true), 2U) << "as the public code: of all UAVs, without expiry";
}

TEST(Xxh, PhotographsTheStructureAndDeliversThePictures) {
  TestWorld world(two_towers(), test_fleet(3), "xxh", 400.0);
  world.run(400.0);
  EXPECT_GT(world.coverage(), 0.4);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.5);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_LE(world.undelivered(), 6U) << "only captures of the last seconds are left";
}

TEST(Xxh, PhotographersWaitUntilTheirSectionIsExplored) {
  TestWorld world(two_towers(), test_fleet(2), "xxh", 200.0);
  world.run(50.0);
  const Vector3d waits = world.position(1);
  EXPECT_GT(waits.z(), 3.0);
  world.run(4.0);
  EXPECT_LT((world.position(1) - waits).norm(), 0.5);
  world.run(110.0);
  EXPECT_GT((world.position(1) - waits).norm(), 3.0);
}

TEST(Xxh, NoUavWaitsForALeaderThatIsNeverHeard) {
  TestScene scene = two_towers();
  scene.talk = false;
  TestWorld silent(scene, test_fleet(2), "xxh", 300.0);
  silent.run(55.0);
  const Vector3d waits = silent.position(1);
  silent.run(200.0);
  EXPECT_GT((silent.position(1) - waits).norm(), 3.0);
  EXPECT_GT(silent.clearance(), kPhotographerRadiusM + 0.5);
}

TEST(Xxh, WithoutALidarItLooksAtTheBoxes) {
  TestWorld world(two_towers(), {{"eye", Role::photographer, {-8.0, -14.0}}}, "xxh", 250.0);
  world.run(250.0);
  EXPECT_GT(world.coverage(), 0.1);
  EXPECT_GT(world.clearance(), kPhotographerRadiusM + 0.5);
}

TEST(Xxh, AFaithfulFleetHitsNothing) {
  TestWorld world(two_towers(), test_fleet(4), "xxh:faithful=true", 200.0);
  world.run(200.0);
  EXPECT_GT(world.highest_m(0), 1.5);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.3);
  EXPECT_GT(world.gap(), 0.3);
}

}  // namespace
}  // namespace skein::agent
