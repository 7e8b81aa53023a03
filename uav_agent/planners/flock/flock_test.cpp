// The parts of the planner flock: survey, surfaces, views, routes, messages. Its points: points_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/math/random_stream.hpp"
#include "uav_agent/planners/flock/reach.hpp"
#include "uav_agent/planners/flock/route.hpp"
#include "uav_agent/planners/flock/surfaces.hpp"
#include "uav_agent/planners/flock/talk.hpp"
#include "uav_agent/planners/flock/views.hpp"
#include "uav_agent/testing/flown_uav.hpp"
#include "uav_agent/testing/test_world.hpp"
#include "uav_agent/testing/three_uavs.hpp"

namespace skein::agent {
namespace {

constexpr double kSharpM = 7.36;

/// Surfaces behind a wall remain to be surveyed until a UAV looks from the other side.
TEST(FlockSurvey, WallsHideWhatIsBehindThem) {
  const std::vector<OrientedBox> boxes = {make_box({0, 0, 12}, {40, 40, 24})};
  VoxelGrid grid = operational_volume(boxes, {}, 12.0, 0.0, 1.5);
  for (VoxelGrid::Id id = 0; id < grid.count(); ++id) {
    if (std::abs(grid.centre_W(id).x()) < 1.0) grid.raise(id, VoxelState::occupied);
  }
  FlockSurvey survey(boxes, 60.0);
  const Vector3d left(-20, 0, 10), right(20, 0, 10);
  for (int look = 0; look < 3; ++look) survey.look(grid, left);
  EXPECT_TRUE(survey.seen(Vector3d(-10, 5, 10)));
  EXPECT_FALSE(survey.seen(Vector3d(10, 5, 10)));
  const std::vector<FlockGap> gaps = survey.gaps();
  ASSERT_FALSE(gaps.empty());
  for (const FlockGap& gap : gaps) EXPECT_GT(gap.middle_W.x(), -4.0);
  for (int look = 0; look < 3; ++look) survey.look(grid, right);
  EXPECT_TRUE(survey.seen(Vector3d(10, 5, 10)));
  EXPECT_LT(survey.gaps().size(), gaps.size());
}

/// The survey gives up surfaces that stayed out of sight from the places chosen to show them, so that no explorer
/// circles there for ever. Surfaces farther away remain.
TEST(FlockSurvey, GapsThatStayOutOfSightAreGivenUp) {
  const std::vector<OrientedBox> boxes = {make_box({0, 0, 12}, {40, 40, 24})};
  VoxelGrid grid = operational_volume(boxes, {}, 12.0, 0.0, 1.5);
  for (VoxelGrid::Id id = 0; id < grid.count(); ++id) {
    if (std::abs(grid.centre_W(id).x()) < 1.0) grid.raise(id, VoxelState::occupied);
  }
  FlockSurvey survey(boxes, 60.0);
  const Vector3d left(-20, 0, 10);
  for (int look = 0; look < 3; ++look) survey.look(grid, left);
  const auto cells = [&] {
    int sum = 0;
    for (const FlockGap& gap : survey.gaps()) sum += gap.cells;
    return sum;
  };
  const int hidden = cells();
  for (int visit = 0; visit < 4; ++visit) survey.visited(left, 25.0);
  EXPECT_LT(cells(), hidden);
  EXPECT_GT(cells(), 0);
  for (const FlockGap& gap : survey.gaps()) EXPECT_GT((gap.middle_W - left).norm(), 12.0);
}

/// A wall 16 m long in a box, as this UAV's map has it, and free space before it.
struct BeforeAWall : FlownUav {
  BeforeAWall() : FlownUav(three_uavs(1), {-10.0, 0.0, 10.0}) {
    boxes = {make_box({4.0, 0.0, 10.0}, {12.0, 20.0, 20.0})};
    clear({-30.0, -20.0, 0.0}, {2.0, 20.0, 26.0});
    build({2.2, -8.0, 2.0}, {2.4, 8.0, 18.0});
    surfaces.emplace(flock, agent, boxes, kSharpM);
    for (int i = 0; i < 40; ++i) surfaces->look_at_map(map);
  }
  Exposure facing_it(double off_m) const {
    const FlockView view{.p_WB = {2.0 - off_m, 0.0, 10.0}, .aim_W = {2.2, 0.0, 10.0}};
    return exposure_of(view, agent);
  }
  std::size_t open_faces() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(surfaces->targets(0), [](const FlockTarget& target) { return !target.known; }));
  }
  std::size_t told_faces() const {
    std::size_t told = 0;
    for (VoxelGrid::Id id = 0; id < surfaces->grid().count(); ++id) {
      for (int face = 0; face < VoxelGrid::kFaces; ++face) told += surfaces->grid().marked(id, face) ? 1 : 0;
    }
    return told;
  }

  FlockConfig flock;
  std::optional<FlockSurfaces> surfaces;
};

/// Faces that were in a picture are no longer open for this UAV. It tells other UAVs once its camera has proved to
/// work.
TEST(FlockSurfaces, FacesAreReportedOnceTheCameraHasProvedToWork) {
  BeforeAWall uav;
  const std::size_t before = uav.open_faces();
  ASSERT_GT(before, 20U);
  uav.surfaces->look_at_picture(uav.facing_it(6.0), 0);
  EXPECT_LT(uav.open_faces(), before);
  EXPECT_EQ(uav.told_faces(), 0U);
  uav.surfaces->detect(std::vector<DetectedPoint>{{{2.2F, 0.0F, 10.0F}, 0.9, 0, {-1.0F, 0.0F, 0.0F}}},
                       {-4.0, 0.0, 10.0});
  EXPECT_GT(uav.told_faces(), 10U);
}

/// If further pictures do not improve a point, the UAV leaves this point alone for a time, and no other.
TEST(FlockSurfaces, APointThatGetsNoBetterIsLeftAloneForATime) {
  BeforeAWall uav;
  const std::vector<DetectedPoint> both = {{{2.2F, 0.0F, 10.0F}, 0.4, 0, {-1.0F, 0.0F, 0.0F}},
                                           {{2.2F, 7.9F, 17.0F}, 0.4, 1, {-1.0F, 0.0F, 0.0F}}};
  uav.surfaces->detect(both, {-4.0, 0.0, 10.0});
  const auto known = [&](Tick now) {
    return std::ranges::count_if(uav.surfaces->targets(now), [](const FlockTarget& target) { return target.known; });
  };
  EXPECT_EQ(known(0), 2);
  for (int i = 0; i < 30; ++i) uav.surfaces->look_at_picture(uav.facing_it(5.0), 0);
  EXPECT_EQ(known(0), 1);
  EXPECT_EQ(known(ticks(600.0)), 2);
}

/// A picture from far away does not show a face well enough. The same picture again gains nothing; a nearer one does.
TEST(FlockSurfaces, APoorPictureGainsNothingASecondTime) {
  BeforeAWall uav;
  const FlockViews views(uav.flock, uav.agent, kSharpM);
  const auto gain = [&](double off_m) {
    const FlockTargets targets(uav.surfaces->targets(0), views.range_m());
    FlockView view{.p_WB = {2.0 - off_m, 0.0, 10.0}, .aim_W = {2.2, 0.0, 10.0}};
    views.judge(*uav.surfaces, targets, view);
    double sum = 0.0;
    for (const FlockView::Sight& sight : view.sights) {
      const FlockTarget& target = targets.all()[sight.target];
      sum += target.points * std::max(0.0, sight.q - target.have);
    }
    return sum;
  };
  for (const double off_m : {12.5, 13.5, 14.5}) {
    const double before = gain(off_m), near = gain(6.0);
    ASSERT_GT(before, 0.5) << off_m;
    for (int i = 0; i < 3; ++i) uav.surfaces->look_at_picture(uav.facing_it(off_m), 0);
    EXPECT_LT(gain(off_m), 0.35 * before) << off_m;
    EXPECT_GT(gain(6.0), 0.3 * near) << off_m;
    uav.surfaces.emplace(uav.flock, uav.agent, uav.boxes, kSharpM);
    for (int i = 0; i < 40; ++i) uav.surfaces->look_at_map(uav.map);
  }
}

/// The UAV cannot turn its camera to some targets. It leaves them out for a while, and does not tell other UAVs.
TEST(FlockSurfaces, ATargetThatTheCameraCannotLookAtIsLeftOutForATime) {
  BeforeAWall uav;
  uav.surfaces->detect(std::vector<DetectedPoint>{{{2.2F, 0.0F, 10.0F}, 0.4, 0, {-1.0F, 0.0F, 0.0F}}},
                       {-4.0, 0.0, 10.0});
  RandomStream random(1, "left_out", 0);
  const std::vector<FlockTarget> all = uav.surfaces->targets(0);
  std::set<std::uint32_t> left;
  for (const FlockTarget& target : all) {
    if (!target.known && random.uniform() < 0.7) continue;
    uav.surfaces->leave_out(target, 0);
    left.insert(target.id);
  }
  ASSERT_GT(left.size(), 5U);
  EXPECT_EQ(uav.surfaces->targets(0).size(), all.size() - left.size());
  for (const FlockTarget& target : uav.surfaces->targets(0)) EXPECT_FALSE(left.contains(target.id));
  EXPECT_EQ(uav.surfaces->targets(ticks(121.0)).size(), all.size());
  EXPECT_EQ(uav.told_faces(), 0U);
}

/// A UAV that takes boxes for structure, because it flies without a map, does not report them: others know more. In a
/// fleet that has no LiDAR at all, all UAVs take them for structure.
TEST(FlockSurfaces, AUavThatTakesBoxesForStructureDoesNotReportThem) {
  BeforeAWall uav;
  const auto occupied = [](const VoxelGrid& grid) {
    std::size_t count = 0;
    for (VoxelGrid::Id id = 0; id < grid.count(); ++id) count += grid.state(id) == VoxelState::occupied;
    return count;
  };
  const FlockSurfaces sees(uav.flock, uav.agent, uav.boxes, kSharpM);
  EXPECT_EQ(&sees.told_grid(), &sees.grid());
  const FlockSurfaces blind(uav.flock, uav.agent, uav.boxes, kSharpM, true);
  EXPECT_GT(occupied(blind.grid()), 100U);
  EXPECT_EQ(occupied(blind.told_grid()), 0U);
  for (FleetMember& member : uav.agent.fleet) member.role = Role::photographer;
  const FlockSurfaces all_blind(uav.flock, uav.agent, uav.boxes, kSharpM, true);
  EXPECT_EQ(&all_blind.told_grid(), &all_blind.grid());
}

/// The qualities that a view before the wall promises are those of the score's formulas for that picture. No view shows
/// anything on the wall's far side.
TEST(FlockViews, AViewPromisesTheQualitiesOfThePictureFromThere) {
  BeforeAWall uav;
  const FlockViews views(uav.flock, uav.agent, kSharpM);
  const FlockTargets targets(uav.surfaces->targets(0), views.range_m());
  uav.navigator.update(uav.input());
  const FreeSpace space = uav.navigator.open_space(uav.input());
  const auto found = views.find(*uav.surfaces, targets, space, uav.state.p_WB, false);
  ASSERT_GT(found.size(), 5U);
  for (const FlockView& view : found) {
    EXPECT_TRUE(space.free(view.p_WB));
    EXPECT_FALSE(view.sights.empty());
    const Exposure exposure = exposure_of(view, uav.agent);
    for (const FlockView::Sight& sight : view.sights) {
      const FlockTarget& target = targets.all()[sight.target];
      const PointQuality quality = exposure.evaluate(target.p_W, target.n_W);
      EXPECT_TRUE(quality.in_fov);
      EXPECT_NEAR(quality.q_res.value_or(-1.0), sight.q, 1e-6);
      EXPECT_GT(target.n_W.dot(view.p_WB - target.p_W), 0.0);
    }
  }
}

/// The less work there is, the more it is worth to survey gaps. Without a lack of work, no explorer surveys any.
TEST(FlockViews, GapsAreWorthMoreTheLessWorkThereIs) {
  BeforeAWall uav;
  const FlockViews views(uav.flock, uav.agent, kSharpM);
  uav.navigator.update(uav.input());
  const FreeSpace space = uav.navigator.open_space(uav.input());
  const auto worth = [&](double lack) {
    std::vector<FlockView> found;
    views.find_gaps(*uav.surfaces, space, uav.state.p_WB, lack, found);
    double sum = 0.0;
    for (const FlockView& view : found) sum += view.survey;
    return sum;
  };
  EXPECT_EQ(worth(0.0), 0.0);
  ASSERT_GT(worth(1.0), 1.0);
  EXPECT_NEAR(worth(0.25), 0.25 * worth(1.0), 1e-9);
}

/// For a while, a UAV leaves out a view that it could not reach, and those beside it. A UAV that makes no progress
/// leaves its view.
TEST(FlockReach, AUavLeavesOutUnreachableViewsForAWhile) {
  FlownUav uav(three_uavs(1), {0.0, 0.0, 10.0});
  const FlockTalk talk({}, uav.agent);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "reach", 0);
    FlockReach reach(uav.agent, talk);
    const Vector3d there(random.uniform(5, 20), random.uniform(-20, 20), random.uniform(5, 20));
    const Vector3d beside = there + Vector3d(1.0, -1.0, 0.5), far = there + Vector3d(0.0, 8.0, 0.0);
    PlannerInput in = uav.input();
    EXPECT_FALSE(reach.out_of_reach(there, in));
    if (seed % 2 == 0) {
      reach.refuse(there, in.tick);
    } else {
      int exchanges = 0;
      for (; !reach.stalls(in, there) && exchanges < 1000; ++exchanges) in.tick += ticks(uav.agent.exchange_period_s);
      ASSERT_LT(exchanges, 1000) << "a UAV that stands must stall";
      EXPECT_FALSE(reach.stalls(in, std::nullopt)) << "it is where it wants to be";
    }
    EXPECT_TRUE(reach.out_of_reach(there, in)) << "seed " << seed;
    EXPECT_TRUE(reach.out_of_reach(beside, in));
    EXPECT_FALSE(reach.out_of_reach(far, in));
    in.tick += ticks(60.0);
    reach.update(in.tick);
    EXPECT_FALSE(reach.out_of_reach(there, in));
    for (int i = 0; i < 200; ++i) {
      in.tick += ticks(uav.agent.exchange_period_s);
      EXPECT_FALSE(reach.stalls(in, std::nullopt));
    }
    in.tick += ticks(uav.agent.exchange_period_s);
    EXPECT_FALSE(reach.stalls(in, there)) << "it has only just set out";
    EXPECT_FALSE(reach.out_of_reach(there, in));
  }
}

/// In a fleet without a LiDAR, UAVs take the boxes for structure, and the space outside for free.
TEST(Flock, PhotographersWithoutAnExplorerFindWork) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomStream random(seed, "photographers", 0);
    TestScene scene;
    for (const double x : {random.uniform(-16.0, -10.0), random.uniform(10.0, 16.0)}) {
      const double width_m = random.uniform(6.0, 9.0), height_m = random.uniform(12.0, 20.0);
      scene.solids.push_back(make_box({x, 0.0, 0.5 * height_m}, {width_m, width_m, height_m}));
      scene.boxes.push_back(make_box({x, 0.0, 0.5 * height_m}, {width_m + 1.0, width_m + 1.0, height_m + 1.0}));
    }
    const std::vector<TestUav> fleet = {{"a", Role::photographer, {-3.0, -16.0}},
                                        {"b", Role::photographer, {3.0, -16.0}}};
    TestWorld world(scene, fleet, "flock", 160.0);
    world.run(120.0);
    EXPECT_GT(world.coverage(), 0.1) << "seed " << seed;
    EXPECT_GT(world.clearance(), kPhotographerRadiusM) << "seed " << seed;
  }
}

/// One box holds the site and the starts: the photographers climb out of it, and photograph what they see from there.
TEST(Flock, PhotographersThatStartInABoxFindWorkOutsideIt) {
  RandomStream random(1, "in_a_box", 0);
  TestScene scene;
  const double width_m = random.uniform(6.0, 9.0), height_m = random.uniform(12.0, 16.0);
  scene.solids = {make_box({0.0, 0.0, 0.5 * height_m}, {width_m, width_m, height_m})};
  scene.boxes = {make_box({0.0, -4.0, 0.5 * height_m}, {width_m + 4.0, 30.0, height_m + 1.0})};
  const std::vector<TestUav> fleet = {{"a", Role::photographer, {-3.0, -16.0}},
                                      {"b", Role::photographer, {3.0, -15.0}}};
  TestWorld world(scene, fleet, "flock", 160.0);
  world.run(120.0);
  EXPECT_GT(world.coverage(), 0.1);
  EXPECT_GT(world.clearance(), kPhotographerRadiusM);
}

/// Drawn views of drawn targets: a route of one view is the best by gain a second, and a longer one counts what two of
/// its views show only once.
TEST(FlockRoute, TakesTheViewsThatGainMostPerSecondAndCountsNoTargetTwice) {
  const std::vector<OrientedBox> boxes = {make_box({0, 0, 12}, {40, 40, 24})};
  const VoxelGrid grid = operational_volume(boxes, {}, 12.0, 0.0, 2.0);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    RandomStream random(seed, "views", 0);
    std::vector<FlockTarget> all;
    for (int i = 0; i < 60; ++i) {
      all.push_back(
          {.p_W = {random.uniform(-20, 20), random.uniform(-20, 20), 10.0}, .points = random.uniform(0.1, 1.0)});
    }
    const FlockTargets targets(all, 10.0);
    std::vector<FlockView> views;
    for (int i = 0; i < 25; ++i) {
      FlockView view{.p_WB = {random.uniform(-20, 20), random.uniform(-20, 20), 10.0}, .aim_W = {0.0, 0.0, 5.0}};
      for (std::uint32_t t = 0; t < all.size(); ++t) {
        if (random.bits() % 8 == 0) view.sights.push_back({t, static_cast<float>(random.uniform(0.2, 1.0))});
      }
      views.push_back(std::move(view));
    }
    const Vector3d here(0, 0, 10), looks = Vector3d::UnitX();
    const FlockPace pace;
    const auto gain_of = [&](const std::vector<std::size_t>& taken) {
      std::vector<double> have(all.size(), 0.0);
      for (const std::size_t i : taken) {
        for (const auto& sight : views[i].sights) have[sight.target] = std::max(have[sight.target], double{sight.q});
      }
      double gain = 0.0;
      for (std::size_t t = 0; t < all.size(); ++t) gain += all[t].points * have[t];
      return gain;
    };
    double best = 0.0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      best = std::max(best, gain_of({i}) / way_s(grid, here, looks, views[i], pace));
    }
    const FlockRoute one = find_route(views, targets, grid, here, looks, pace, 0.0, 1, std::nullopt);
    ASSERT_EQ(one.views.size(), 1U);
    EXPECT_NEAR(one.rate(), best, 1e-5 * best) << "seed " << seed;
    const FlockRoute four = find_route(views, targets, grid, here, looks, pace, 0.0, 4, std::nullopt);
    ASSERT_LE(four.views.size(), 4U);
    EXPECT_LE(four.gain, gain_of(four.views) + 1e-5) << "later views count less, never more; seed " << seed;
    EXPECT_EQ(std::set(four.views.begin(), four.views.end()).size(), four.views.size());
  }
}

/// The other UAVs receive a UAV's claims, and keep them until they are too old.
TEST(FlockTalk, ClaimsAreHeardAndLapse) {
  const AgentConfig sender_config = three_uavs(0), listener_config = three_uavs(2);
  FlockTalk sender({}, sender_config), listener({}, listener_config);
  BeforeAWall said, heard;
  const std::vector<FlockClaim> claims = {{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}, {{-1.5, 2.25, 8.0}, {0.0, 0.0, 1.0}}};
  const FlockWord word{.claims = claims, .rate = 2.5};
  const Peers peers = all_in_sight(sender_config);
  std::vector<RadioMessage> radio;
  for (std::uint64_t k = 0; k < 20; ++k) {
    PlannerInput in = said.input();
    PlannerOutput out;
    const PlannerInput at{.k = k,
                          .tick = static_cast<Tick>(20 * k),
                          .state = in.state,
                          .gimbal = {},
                          .tracking = in.tracking,
                          .map = in.map,
                          .boxes = in.boxes,
                          .peers = peers,
                          .mission_remaining_s = {},
                          .detected = {},
                          .radio = {}};
    sender.speak(at, said.surfaces->grid(), said.surfaces->points(), word, out);
    radio.insert(radio.end(), out.radio.begin(), out.radio.end());
  }
  ASSERT_FALSE(radio.empty());
  PlannerInput in = heard.input();
  in.radio = radio;
  listener.listen(in, heard.surfaces->grid(), heard.surfaces->points());
  const auto now = listener.claims(in.tick);
  ASSERT_EQ(now.size(), 1U);
  EXPECT_EQ(now[0].first, 0U);
  ASSERT_EQ(now[0].second.size(), claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    EXPECT_LT((now[0].second[i].p_WB - claims[i].p_WB).norm(), 0.02);
    EXPECT_LT((now[0].second[i].aim_W - claims[i].aim_W).norm(), 0.02);
  }
  EXPECT_TRUE(listener.claims(in.tick + ticks(60.0)).empty());
  ASSERT_EQ(listener.rates(in.tick).size(), 1U);
  EXPECT_NEAR(listener.rates(in.tick).front(), word.rate, 0.06);
  EXPECT_TRUE(listener.rates(in.tick + ticks(60.0)).empty());
}

}  // namespace
}  // namespace skein::agent
