// The XXH planner: the map of a region, what its UAVs tell each other, and flights in a world without physics.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "uav_agent/planners/xxh/inspect.hpp"
#include "uav_agent/planners/xxh/talk.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kExplorerRadiusM = 0.63, kPhotographerRadiusM = 0.32;

const OrientedBox kBox = make_box({0.0, 0.0, 20.0}, {10.0, 8.0, 30.0}, 0.4);
constexpr int kUpright = 2;

XxhRegionMap region_map(bool from_high_end = false) { return {XxhRegionMap::Config(), kBox, kUpright, from_high_end}; }

TEST(XxhRegion, LayersRunFromTheEndThatIsEntered) {
  for (const bool from_high_end : {false, true}) {
    const XxhRegionMap region = region_map(from_high_end);
    const auto low = region.grid().at(Vector3d(0.0, 0.0, 6.0)), high = region.grid().at(Vector3d(0.0, 0.0, 34.0));
    ASSERT_TRUE(low && high);
    EXPECT_EQ(region.layer(*low) > region.layer(*high), from_high_end);
  }
}

TEST(XxhRegion, SectionsCutTheLayersWithoutGap) {
  const XxhRegionMap region = region_map();
  for (const double last_share : {0.5, 1.0}) {
    for (std::size_t count = 1; count <= 8; ++count) {
      int at = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const auto section = region.section(i, count, last_share);
        EXPECT_EQ(section.first, at);
        EXPECT_GE(section.last, section.first);
        at = section.last;
      }
      EXPECT_EQ(at, region.grid().dims().z());
    }
  }
}

TEST(XxhRegion, TheSpiralGoesAroundTheBoxAtADistance) {
  const XxhRegionMap region = region_map();
  const Vector3d from(-30.0, -30.0, 0.0);
  const auto places = region.spiral(region.section(0, 1, 1.0), from);
  ASSERT_GT(places.size(), 10U);
  std::set<double> heights;
  for (const Vector3d& p : places) {
    EXPECT_FALSE(kBox.contains(p, 3.9));
    EXPECT_TRUE(kBox.contains(p, 4.1));
    heights.insert(std::round(p.z()));
  }
  EXPECT_EQ(heights.size(), 2U) << "turns over 12 layers";
  const double nearest = (places.front() - from).head<2>().norm();
  for (const Vector3d& p : places) EXPECT_LE(nearest, (p - from).head<2>().norm() + 1e-9);
  EXPECT_LT(region.spiral(region.section(0, 1, 1.0), from, true).size(), places.size());
}

/// One occupied cell in the middle of the box, in known free space.
struct LoneCell {
  XxhRegionMap region = region_map();
  OccupancyMap map;
  std::vector<OrientedBox> no_boxes;
  FreeSpace space{FreeSpace::Config(), no_boxes, map};

  LoneCell() {
    map.insert({{0.1F, 0.1F, 20.1F}}, std::nullopt);
    region.update(map);
  }
  VoxelGrid::Id cube() const { return *region.grid().at(Vector3d(0.1, 0.1, 20.1)); }
  std::vector<XxhVisit> visits(int layer) const {
    return region.nearest_visits({10.0, 0.0, 20.0}, layer, space, {}, 100);
  }
};

TEST(XxhRegion, CellsBesideAnOccupiedOneAreVisitedAndLookAtIt) {
  const LoneCell world;
  std::size_t found = 0;
  for (int layer = 0; layer < world.region.grid().dims().z(); ++layer) {
    for (const XxhVisit& visit : world.visits(layer)) {
      ++found;
      EXPECT_EQ(world.region.layer(visit.cell), layer);
      ASSERT_EQ(visit.targets.size(), 1U);
      const XxhTarget& target = visit.targets.front();
      EXPECT_EQ(target.cube, world.cube());
      EXPECT_NEAR((visit.p_WB - target.surface_W).dot(target.out_W), XxhRegionMap::Config().farthest_m, 0.01);
      EXPECT_TRUE(world.space.free(visit.p_WB));
    }
  }
  EXPECT_EQ(found, 6U);
}

TEST(XxhRegion, WhatWasLookedAtIsNoTargetAnyMore) {
  LoneCell world;
  const int layer = world.region.layer(world.cube());
  const auto before = world.visits(layer);
  ASSERT_EQ(before.size(), 4U);
  world.region.grid().mark(before.front().targets.front().cube, before.front().targets.front().face);
  EXPECT_EQ(world.visits(layer).size(), 3U);
}

TEST(XxhRegion, SurfaceOutsideTheBoxIsNoTarget) {
  XxhRegionMap region = region_map();
  OccupancyMap map;
  map.insert({{0.0F, 0.0F, 38.0F}}, std::nullopt);
  region.update(map);
  for (VoxelGrid::Id id = 0; id < region.grid().count(); ++id) EXPECT_TRUE(region.targets(id).empty());
}

TEST(XxhRegion, NothingKnownIsNotEmpty) {
  XxhRegionMap region = region_map();
  const auto all = region.section(0, 1, 1.0);
  EXPECT_FALSE(region.is_empty(all));
  for (VoxelGrid::Id id = 0; id < region.grid().count(); ++id) region.grid().raise(id, VoxelState::free);
  EXPECT_TRUE(region.is_empty(all));
  region.grid().raise(*region.grid().at(kBox.center), VoxelState::occupied);
  EXPECT_FALSE(region.is_empty(all));
}

TEST(XxhInspector, GoesOverEveryThirdLayerOnceAndAgainForWhatWasNotReached) {
  LoneCell world;
  const XxhConfig config;
  const AgentConfig agent;
  XxhInspector inspector(config, agent);
  inspector.begin(world.region.section(0, 1, 1.0));
  std::set<int> layers;
  int rounds = 0;
  while (!inspector.finished() && rounds++ < 1000) {
    for (const XxhVisit& visit : inspector.candidates(world.region, {10.0, 0.0, 20.0}, world.space)) {
      layers.insert(world.region.layer(visit.cell));
      inspector.failed(visit.cell);
    }
  }
  EXPECT_TRUE(inspector.finished());
  EXPECT_GT(inspector.pass(), 1);
  for (const int layer : layers) EXPECT_EQ(layer % config.layer_step, config.layer_step / 2);
}

TEST(XxhTalk, WordsSurviveTheRadio) {
  XxhWord word;
  word.start_W = {1.0, -2.0, 0.25};
  word.has_plan = word.done = true;
  word.region = 7;
  word.explored = 3;
  word.way_W = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  PayloadWriter writer;
  write_word(word, writer);
  PayloadReader reader(writer.data());
  const auto heard = read_word(reader);
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->start_W, word.start_W);
  EXPECT_TRUE(heard->has_plan && heard->done && !heard->acknowledged);
  EXPECT_EQ(heard->region, 7);
  EXPECT_EQ(heard->explored, 3);
  EXPECT_EQ(heard->way_W, word.way_W);
  for (std::size_t length = 0; length < writer.size(); ++length) {
    PayloadReader cut(std::span(writer.data()).first(length));
    EXPECT_FALSE(read_word(cut));
  }
}

/// A UAV of a fleet that hears the first and the last of it say where they are about to fly.
std::size_t keeps_clear_of(std::size_t self, double after_s, bool forever) {
  AgentConfig agent;
  agent.self = UavIndex(self);
  for (const TestUav& uav : test_fleet(4)) agent.fleet.push_back({uav.name, uav.role, {0.0, 0.0, 0.0}, 0.5});
  XxhTalk talk({.forever = forever}, agent);
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

TEST(XxhTalk, WhoHasLessPriorityKeepsClearOfTheOthersTrajectoriesForAWhile) {
  EXPECT_EQ(keeps_clear_of(1, 1.0, false), 1U) << "a photographer: of the explorer, not of the photographer behind it";
  EXPECT_EQ(keeps_clear_of(2, 1.0, false), 1U) << "the second explorer: of the first, not of any photographer";
  EXPECT_EQ(keeps_clear_of(1, 60.0, false), 0U);
  EXPECT_EQ(keeps_clear_of(1, 60.0, true), 2U) << "as the public code: of everybody, for ever";
}

TEST(Xxh, PhotographsTheStructureAndBringsItHome) {
  TestWorld world(two_towers(), test_fleet(3), "xxh", 400.0);
  world.run(400.0);
  EXPECT_GT(world.coverage(), 0.4);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.5);
  EXPECT_GT(world.separation(), 2.0 * kExplorerRadiusM + 0.5);
  EXPECT_LE(world.undelivered(), 6U) << "only those of the last seconds";
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

TEST(Xxh, NobodyWaitsForALeaderThatIsNeverHeard) {
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

TEST(Xxh, FaithfulToThePublicCodeItStillHitsNothing) {
  TestWorld world(two_towers(), test_fleet(4), "xxh:faithful=true", 200.0);
  world.run(200.0);
  EXPECT_GT(world.highest_m(0), 1.5);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.3);
  EXPECT_GT(world.separation(), 2.0 * kExplorerRadiusM);
}

}  // namespace
}  // namespace skein::agent
