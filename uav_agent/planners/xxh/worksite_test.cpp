// The present region: the end at which work begins, the decisions for the team, and values that depend only on the box.
#include "uav_agent/planners/xxh/worksite.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/math/random_stream.hpp"
#include "uav_agent/planners/xxh/post.hpp"
#include "uav_agent/planners/xxh/talk.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kClearanceM = 1.7;

/// An upright box, whose longest edge points up, or down if it is upside down.
OrientedBox upright(bool upside_down = false) {
  OrientedBox box = make_box({30.0, 10.0, 20.0}, {8.0, 10.0, 36.0}, 0.4);
  if (upside_down) box.R_WO = box.R_WO * Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()).toRotationMatrix();
  return box;
}
const OrientedBox kLying = make_box({30.0, 10.0, 10.0}, {40.0, 10.0, 12.0}, 0.4);

struct AtWorksite {
  explicit AtWorksite(XxhConfig of_config = {}) : config(of_config.resolved()) { agent.fleet = {{.name = "a"}}; }
  void enter(const OrientedBox& box, bool from_high_end = false) {
    site.enter({.from_high_end = from_high_end}, box, {0.0, 0.0, 0.0}, kClearanceM);
  }
  XxhRegionMap::Section all() { return site.map().section(0, 1, 1.0); }
  /// Height of the first layer above that of the last one: negative if the region begins at its foot.
  double begins_above_m() {
    const VoxelGrid& grid = site.map().grid();
    double first_m = 0.0, last_m = 0.0;
    for (VoxelGrid::Id id = 0; id < grid.count(); ++id) {
      if (site.map().layer(id) == 0) first_m = grid.centre_W(id).z();
      if (site.map().layer(id) == grid.dims().z() - 1) last_m = grid.centre_W(id).z();
    }
    return first_m - last_m;
  }

  const XxhConfig config;
  AgentConfig agent;
  XxhWorksite site{config, agent};
};

TEST(XxhWorksite, AnUprightRegionBeginsAtItsFootWhereverThePathComesFrom) {
  for (const bool upside_down : {false, true}) {
    for (const bool from_high_end : {false, true}) {
      AtWorksite at;
      at.enter(upright(upside_down), from_high_end);
      EXPECT_FALSE(at.site.decided());
      EXPECT_LT(at.begins_above_m(), -20.0);
      EXPECT_LT(at.site.entry_W().z(), 20.0);
    }
  }
}

TEST(XxhWorksite, ARegionThatIsTooLargeForItsCellsGetsLargerOnes) {
  XxhConfig fine;
  fine.voxel_m = 1.0;
  AtWorksite usual(fine), large(fine);
  usual.enter(kLying);
  EXPECT_EQ(usual.site.map().grid().voxel_m(), 1.0);
  large.enter(make_box({0.0, 0.0, 75.0}, {900.0, 600.0, 150.0}));
  EXPECT_GT(large.site.map().grid().voxel_m(), 1.5);
  EXPECT_LT(large.site.map().grid().voxel_m(), 2.0);
}

TEST(XxhWorksite, LyingBoxesAndThePublicCodeBeginWhereThePathComesFrom) {
  XxhConfig by_path;
  by_path.begin = XxhBegin::path;
  for (const bool from_high_end : {false, true}) {
    AtWorksite lying, path(by_path);
    lying.enter(kLying, from_high_end);
    path.enter(upright(), from_high_end);
    EXPECT_TRUE(lying.site.decided() && path.site.decided());
    EXPECT_EQ(lying.site.from_high_end(), from_high_end);
    EXPECT_EQ(path.begins_above_m() > 0.0, from_high_end);
  }
}

TEST(XxhWorksite, BeginsInTheOpenIfAPlaceOfTheFirstTurnIsProved) {
  AtWorksite at;
  at.enter(upright());
  const std::vector<OrientedBox> no_boxes;
  const OccupancyMap hits;
  const auto turn = at.site.map().spiral(at.all(), {0.0, 0.0, 0.0});
  RandomStream random(3, "proof", 0);
  for (int trial = 0; trial < 10; ++trial) {
    WorldMap map{WorldMap::Config{}};
    const auto open = [&](Tick now) {
      BodyFit fit(1.0, 1.0);
      fit.update(map, now);
      const FreeSpace proved({.clearance_m = 1.0, .world = &map, .fit = &fit, .proved_only = true}, no_boxes, hits);
      return at.site.begins_in_the_open(at.all(), proved, Vector3d::Zero());
    };
    EXPECT_FALSE(open(0));
    map.set_free(turn[random.bits() % turn.size()], 6.0);
    EXPECT_TRUE(open(1));
  }
}

TEST(XxhWorksite, OnlyADecisionForTheOtherEndReplacesTheMap) {
  AtWorksite at;
  at.enter(upright());
  const auto id = *at.site.map().grid().at(upright().center);
  at.site.map().grid().raise(id, VoxelState::occupied);
  EXPECT_FALSE(at.site.decide(at.site.from_high_end()));
  EXPECT_TRUE(at.site.decided());
  EXPECT_TRUE(at.site.map().anything_known());
  EXPECT_TRUE(at.site.decide(!at.site.from_high_end()));
  EXPECT_GT(at.begins_above_m(), 20.0);
  EXPECT_FALSE(at.site.map().anything_known()) << "it is a new map";
  EXPECT_LT(at.site.far_end_W().z(), 5.0) << "the team leaves it at its foot";
}

TEST(XxhWorksite, WithoutAMapItBeginsAtTheTopAndSharesNothing) {
  AtWorksite at;
  at.enter(upright());
  EXPECT_TRUE(at.site.shared_grid());
  at.site.go_by_the_box();
  EXPECT_TRUE(at.site.is_solid() && at.site.decided() && at.site.map().anything_known());
  EXPECT_GT(at.begins_above_m(), 20.0);
  EXPECT_FALSE(at.site.shared_grid());
  at.enter(upright());
  EXPECT_FALSE(at.site.is_solid()) << "another region, another map";
}

/// A UAV takes in a region's map only from UAVs at the same region that began it at the same end.
TEST(XxhTalk, MapsOfOtherRegionsAreNotTakenIn) {
  AgentConfig self, other;
  for (const TestUav& uav : test_fleet(2)) self.fleet.push_back({uav.name, uav.role, {0.0, 0.0, 0.0}, 0.5});
  other = self;
  other.self = UavIndex(1);
  const OccupancyMap hits;
  const std::vector<OrientedBox> boxes;
  for (const int region : {0, 1}) {
    for (const bool high : {false, true}) {
      XxhTalk listens({}, self), speaks({}, other);
      listens.new_map(0, false);
      speaks.new_map(static_cast<std::uint16_t>(region), high);
      VoxelGrid mine(Isometry3d::Identity(), {20.0, 20.0, 20.0}, 2.5), theirs = mine;
      theirs.raise(5, VoxelState::occupied);
      XxhWord said, own;
      said.region = static_cast<std::uint16_t>(region);
      said.from_high_end = high;
      for (std::uint64_t k = 0; k < 200; ++k) {  // exchanges in which both learn what the other has
        const Tick tick = static_cast<Tick>(k) * ticks(self.exchange_period_s);
        PlannerOutput from_mine, from_theirs;
        Peers near_self(self), near_other(other);
        near_self.update(tick, {{node_of_uav(UavIndex(1)), Vector3d::Zero(), {}}});
        near_other.update(tick, {{node_of_uav(UavIndex(0)), Vector3d::Zero(), {}}});
        listens.speak({k, tick, {}, {}, {}, hits, boxes, near_self, {}, false, 0, {}, {}}, &mine, own, from_mine);
        const auto& heard = from_mine.radio;
        speaks.listen({k, tick, {}, {}, {}, hits, boxes, near_other, {}, false, 0, {}, heard}, &theirs);
        speaks.speak({k, tick, {}, {}, {}, hits, boxes, near_other, {}, false, 0, {}, {}}, &theirs, said, from_theirs);
        const auto& told = from_theirs.radio;
        listens.listen({k, tick, {}, {}, {}, hits, boxes, near_self, {}, false, 0, {}, told}, &mine);
      }
      EXPECT_EQ(mine.state(5) == VoxelState::occupied, region == 0 && !high) << "region " << region << high;
    }
  }
}

TEST(XxhPost, PostsThatSeeMostOfTheExplorersWayComeFirst) {
  const std::vector<OrientedBox> flat = {make_box({0.0, 0.0, 5.0}, {30.0, 30.0, 10.0})};
  const OccupancyMap hits;
  const FreeSpace space(FreeSpace::Config{}, flat, hits);
  std::vector<Vector3d> around;
  for (const double x : {-20.0, 20.0}) {
    for (const double y : {-20.0, 20.0}) around.emplace_back(x, y, 8.0);
  }
  const Vector3d low(24.0, 24.0, 4.0), high(24.0, 24.0, 60.0);
  std::vector<Vector3d> posts = {low, high};
  sort_by_sight(around, space, posts);
  EXPECT_EQ(posts.front(), high) << "from high above a flat box, it sees the whole way";
  posts = {low, low + Vector3d(0.0, 0.0, 1.0)};
  sort_by_sight(around, space, posts);
  EXPECT_EQ(posts.front(), low) << "of places that see as much, the first stays first";
}

}  // namespace
}  // namespace skein::agent
