// XXH's map of a region, and what its UAVs do there: where an inspector stops and looks, where an explorer flies.
#include "uav_agent/planners/xxh/region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/math/random_stream.hpp"
#include "uav_agent/planners/xxh/explore.hpp"
#include "uav_agent/planners/xxh/inspect.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

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
  EXPECT_EQ(heights.size(), 2U) << "two turns cover 12 layers";
  const double nearest = (places.front() - from).head<2>().norm();
  for (const Vector3d& p : places) EXPECT_LE(nearest, (p - from).head<2>().norm() + 1e-9);
  EXPECT_LT(region.spiral(region.section(0, 1, 1.0), from, true).size(), places.size());
}

void tell(WorldMap& map, const Vector3d& p_W) { map.hear(map.cube_of(p_W), 0, Space::occupied, kOwn + 1); }

/// One occupied cell in the middle of the box, in known free space.
struct LoneCell {
  XxhRegionMap region = region_map();
  WorldMap world{WorldMap::Config{}};
  OccupancyMap map;
  std::vector<OrientedBox> no_boxes;
  FreeSpace space{FreeSpace::Config(), no_boxes, map};

  LoneCell() {
    tell(world, {0.1, 0.1, 20.1});
    region.update(world);
  }
  Vector3d cell_W() const { return region.targets(*region.grid().neighbour(cube(), 0)).front().surface_W; }
  VoxelGrid::Id cube() const { return *region.grid().at(Vector3d(0.1, 0.1, 20.1)); }
  std::vector<XxhVisit> visits(int layer) const {
    return region.visits({10.0, 0.0, 20.0}, layer, XxhOrder::nearest, space, {}, 100);
  }
};

TEST(XxhRegion, CellsBesideAnOccupiedCellAreVisitedToLookAtIt) {
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

/// The test draws structure in one layer. Visits in the order of the spiral lead around it once, in the direction in
/// which the explorer flies.
TEST(XxhRegion, TheSpiralVisitsAllCellsOfALayerOnceAround) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "layer", 0);
    LoneCell world;
    for (int i = 0; i < 12; ++i) {
      const Vector3d p_B(random.uniform(-4.5, 4.5), random.uniform(-3.5, 3.5), 0.1);
      tell(world.world, kBox.center + kBox.R_WO * p_B);
    }
    world.region.update(world.world);
    const int layer = world.region.layer(world.cube());
    std::set<VoxelGrid::Id> done;
    Vector3d at_W(30.0, 0.0, 20.0);
    double turned = 0.0, backwards = 0.0;
    std::size_t visited = 0;
    const auto visits = [&](XxhOrder order, std::size_t most) {
      return world.region.visits(at_W, layer, order, world.space, done, most);
    };
    const std::size_t all = visits(XxhOrder::nearest, 1000).size();
    for (auto next = visits(XxhOrder::spiral, 1); !next.empty(); next = visits(XxhOrder::spiral, 1), ++visited) {
      const Vector3d from = at_W - kBox.center, to = world.region.grid().centre_W(next.front().cell) - kBox.center;
      const double turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.head<2>().dot(to.head<2>()));
      if (visited > 0) (turn < 0.0 ? backwards : turned) += std::abs(turn);
      at_W = world.region.grid().centre_W(next.front().cell);
      done.insert(next.front().cell);
    }
    EXPECT_EQ(visited, all) << "seed " << seed;
    EXPECT_LT(turned - backwards, 2.5 * std::numbers::pi) << "seed " << seed << ": the visits lead around once";
    EXPECT_LT(backwards, turned) << "seed " << seed;
  }
}

TEST(XxhRegion, ATargetWithoutFreeSpaceNearbyIsLookedAtFromFartherOff) {
  LoneCell world;
  const Vector3d there_W = world.cell_W();
  const FreeSpace space(FreeSpace::Config(), world.no_boxes, world.map, {{there_W, 5.0}});
  std::size_t found = 0;
  for (int layer = 0; layer < world.region.grid().dims().z(); ++layer) {
    for (const XxhVisit& visit : world.region.visits({10.0, 0.0, 20.0}, layer, XxhOrder::nearest, space, {}, 100)) {
      ++found;
      EXPECT_NEAR((visit.p_WB - there_W).dot(visit.targets.front().out_W), XxhRegionMap::Config().limit_m, 0.01);
    }
  }
  EXPECT_EQ(found, 6U);
}

TEST(XxhRegion, ATargetBehindAPillarIsLookedAtFromAside) {
  LoneCell world;
  const int layer = world.region.layer(world.cube());
  const auto in_front = world.visits(layer);
  ASSERT_FALSE(in_front.empty());
  const XxhTarget target = in_front.front().targets.front();
  std::vector<Sphere> pillar;
  for (const double up : {-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0}) {
    pillar.push_back({target.surface_W + 2.9 * target.out_W + up * Vector3d::UnitZ(), 2.0});
  }
  const FreeSpace space(FreeSpace::Config(), world.no_boxes, world.map, pillar);
  const auto visits = world.region.visits({10.0, 0.0, 20.0}, layer, XxhOrder::nearest, space, {}, 100);
  EXPECT_EQ(visits.size(), in_front.size());
  for (const XxhVisit& visit : visits) {
    if (visit.cell != in_front.front().cell) continue;
    EXPECT_TRUE(space.free(visit.p_WB));
    EXPECT_LT((visit.p_WB - target.surface_W).norm(), XxhRegionMap::Config().farthest_m + 0.01);
    EXPECT_GT((visit.p_WB - target.surface_W).dot(target.out_W), 0.0) << "on the side to which the face points";
  }
}

TEST(XxhRegion, AFaceThatWasLookedAtIsNoTargetAnyMore) {
  LoneCell world;
  const int layer = world.region.layer(world.cube());
  const auto before = world.visits(layer);
  ASSERT_EQ(before.size(), 4U);
  world.region.grid().mark(before.front().targets.front().cube, before.front().targets.front().face);
  EXPECT_EQ(world.visits(layer).size(), 3U);
}

TEST(XxhRegion, SurfaceOutsideTheBoxIsNoTarget) {
  XxhRegionMap region = region_map();
  WorldMap map{WorldMap::Config{}};
  tell(map, {0.0, 0.0, 38.0});
  region.update(map);
  for (VoxelGrid::Id id = 0; id < region.grid().count(); ++id) EXPECT_TRUE(region.targets(id).empty());
}

// With structure at random places: targets are faces of the structure on the map, and each face that is visible from
// the cell beside it is a target of that cell, and of no other.
TEST(XxhRegion, EveryExposedFaceIsATargetOfExactlyOneCell) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "region", 0);
    XxhRegionMap region = region_map(seed % 2 == 0);
    WorldMap map{WorldMap::Config{}};
    std::set<VoxelGrid::Id> structure;
    for (int i = 0; i < 60; ++i) {
      const Vector3d p_B(random.uniform(-4.5, 4.5), random.uniform(-3.5, 3.5), random.uniform(-14.0, 14.0));
      const Vector3d p_W = kBox.center + kBox.R_WO * p_B;
      tell(map, p_W);
      const Vector3d middle_W = (map.cube_of(p_W).cast<double>() + Vector3d::Constant(0.5)) * map.config().cell_m;
      structure.insert(*region.grid().at(middle_W));
    }
    region.update(map);
    std::set<std::pair<VoxelGrid::Id, int>> seen, wanted;
    for (VoxelGrid::Id id = 0; id < region.grid().count(); ++id) {
      for (const XxhTarget& target : region.targets(id)) {
        EXPECT_EQ(region.grid().at(target.surface_W), target.cube);
        EXPECT_TRUE(seen.insert({target.cube, target.face}).second) << "no face is a target of two cells";
      }
    }
    for (const VoxelGrid::Id cube : structure) {
      for (int face = 0; face < VoxelGrid::kFaces; ++face) {
        const auto beside = region.grid().neighbour(cube, face);
        if (beside && !structure.contains(*beside)) wanted.insert({cube, face});
      }
    }
    EXPECT_EQ(seen, wanted) << seed;
  }
}

TEST(XxhRegion, ASectionIsEmptyOnlyIfItWasSeenToBeFree) {
  XxhRegionMap region = region_map();
  const auto all = region.section(0, 1, 1.0);
  WorldMap map{WorldMap::Config{}};
  region.update(map);
  EXPECT_FALSE(region.is_empty(all));
  EXPECT_FALSE(region.anything_known());
  map.set_free(kBox.center, 20.0);
  region.update(map);
  EXPECT_TRUE(region.is_empty(all));
  region.grid().raise(*region.grid().at(kBox.center), VoxelState::occupied);
  EXPECT_FALSE(region.is_empty(all));
  EXPECT_TRUE(region.anything_known());
}

/// An inspector whose flight core reports the outcome that the test sets for every choice.
struct Inspecting : LoneCell {
  explicit Inspecting(Outcome::Kind all_become, int layer_step = 1) : kind(all_become) {
    config.layer_step = layer_step;
    config = config.resolved();
    agent.fleet = {{.name = "a"}};
    inspector.begin(region.section(0, 1, 1.0));
  }
  /// One exchange.   @returns the choices.
  std::vector<Goal> exchange() {
    const Peers peers(agent);
    PlannerInput in{0, 0, {}, {}, {}, map, no_boxes, peers, {}, false, 0, {}, {}};
    in.flight = {.working = true, .outcomes = std::move(outcomes)};
    outcomes.clear();
    errand.listen(in);
    inspector.hear(errand);
    if (inspector.visit() || inspector.finished() || errand.under_way()) return {};
    PlannerOutput out;
    errand.set_out(inspector.choices(region, {10.0, 0.0, 20.0}, space), out);
    for (const Goal& goal : *out.goals) {
      outcomes.push_back({.id = goal.id, .kind = kind});
      if (kind != Outcome::Kind::no_way) break;
    }
    return *out.goals;
  }
  const Outcome::Kind kind;
  XxhConfig config;
  AgentConfig agent;
  XxhInspector inspector{config, agent};
  XxhErrand errand;
  std::vector<Outcome> outcomes;
};

/// Inspectors visit each layer (as in the paper), each third one (as in the public code), or as configured.
class XxhInspectorLayers : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Steps, XxhInspectorLayers, testing::Values(1, 2, 3, 5));

TEST_P(XxhInspectorLayers, AreVisitedThreeTimesIfTargetsAreNotReached) {
  Inspecting world(Outcome::Kind::no_way, GetParam());
  std::map<int, int> tried;  // choices, by layer
  for (int i = 0; i < 1000 && !world.inspector.finished(); ++i) {
    for (const Goal& goal : world.exchange()) ++tried[world.region.layer(*world.region.grid().at(goal.way[0].p_WB))];
  }
  EXPECT_TRUE(world.inspector.finished());
  ASSERT_FALSE(tried.empty());
  for (const auto& [layer, times] : tried) {
    EXPECT_EQ(layer % GetParam(), GetParam() / 2);
    EXPECT_EQ(times % 3, 0) << "each cell is tried in three passes";
  }
}

TEST(XxhInspector, VisitsTheCellThatItReachedAndLooksAtItsTargets) {
  Inspecting world(Outcome::Kind::reached);
  std::vector<Goal> goals;
  for (int i = 0; i < 100 && goals.empty(); ++i) goals = world.exchange();
  ASSERT_FALSE(goals.empty());
  EXPECT_FALSE(world.inspector.visit());
  ASSERT_TRUE(world.inspector.ahead(0, world.region));
  world.exchange();
  ASSERT_TRUE(world.inspector.visit());
  EXPECT_EQ(world.inspector.visit()->p_WB, goals.front().way.front().p_WB);
  EXPECT_EQ(std::get<Vector3d>(goals.front().gimbal), world.inspector.target().surface_W);
  const XxhTarget target = world.inspector.target();
  world.region.grid().mark(target.cube, target.face);
  EXPECT_FALSE(world.inspector.ahead(0, world.region)) << "another UAV has looked at it";
  world.inspector.leave();
  EXPECT_FALSE(world.inspector.visit());
}

/// An explorer around a box of which little is known yet.
struct Exploring : LoneCell {
  static constexpr double kAtMostS = 60.0;

  Exploring() {
    agent.fleet = {{.name = "a"}};
    run([&](const PlannerInput& in) { explorer.begin(region, region.section(0, 1, 1.0), kAtMostS, in); });
  }
  template <class Decide>
  void run(const Decide& decide) {
    const Peers peers(agent);
    PlannerInput in{0, 0, {}, {}, {.setpoint = {.p_WB = here_W}}, map, no_boxes, peers, {}, false, 0, {}, {}};
    in.flight = {.working = true, .outcomes = std::move(outcomes)};
    in.space = &space;
    outcomes.clear();
    decide(in);
  }
  /// @returns the choices; empty: it has finished.
  std::vector<Goal> exchange() {
    PlannerOutput out;
    run([&](const PlannerInput& in) {
      errand.listen(in);
      explorer.look_inwards(region, in, out);
      explorer.hear(errand);
      if (!errand.under_way()) errand.set_out(explorer.choices(space), out);
    });
    return out.goals.value_or(std::vector<Goal>());
  }
  const XxhConfig config = XxhConfig().resolved();
  AgentConfig agent;
  XxhExplorer explorer{config};
  XxhErrand errand;
  std::vector<Outcome> outcomes;
  Vector3d here_W = {-30.0, -30.0, 10.0};
};

TEST(XxhExplorer, FliesAlongAllPlacesOfTheSpiralInTheirOrder) {
  Exploring world;
  std::vector<Vector3d> flown;
  for (int i = 0; i < 100; ++i) {
    const auto goals = world.exchange();
    if (goals.empty()) break;
    for (const Waypoint& waypoint : goals.front().way) {
      flown.push_back(waypoint.p_WB);
      world.here_W = waypoint.p_WB;
      world.exchange();
    }
    world.outcomes = {{.id = goals.front().id, .kind = Outcome::Kind::reached}};
  }
  const auto spiral = world.region.spiral(world.region.section(0, 1, 1.0), {-30.0, -30.0, 10.0});
  EXPECT_EQ(flown, spiral);
}

TEST(XxhExplorer, APlaceThatCannotBeReachedIsTriedOnceMoreAtTheEnd) {
  Exploring world;
  int choices = 0;
  for (int i = 0; i < 1000; ++i) {
    for (const Goal& goal : world.exchange()) {
      ++choices;
      world.outcomes.push_back({.id = goal.id, .kind = Outcome::Kind::no_way});
    }
  }
  const auto spiral = world.region.spiral(world.region.section(0, 1, 1.0), {-30.0, -30.0, 10.0});
  EXPECT_EQ(choices, 2 * static_cast<int>(spiral.size()));
}

TEST(XxhExplorer, HasFinishedWhenItsTimeIsOver) {
  Exploring world;
  EXPECT_FALSE(world.exchange().empty());
  const auto finished_at = [&](double s) {
    bool finished = false;
    world.run([&](PlannerInput in) {
      in.tick = ticks(s);
      EXPECT_EQ(world.explorer.late(in), s > Exploring::kAtMostS);
      finished = world.explorer.finished(world.region, in);
    });
    return finished;
  };
  EXPECT_FALSE(finished_at(Exploring::kAtMostS - 1.0));
  EXPECT_TRUE(finished_at(Exploring::kAtMostS + 1.0));
}

}  // namespace
}  // namespace skein::agent
