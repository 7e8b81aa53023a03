// UAVs whose paths cross keep apart: the second UAV waits. A UAV skips views that it cannot reach.
#include "sim_server/plan/schedule.hpp"

#include <gtest/gtest.h>

#include "sim_server/testing/plan_site.hpp"

namespace skein::sim {
namespace {

TEST(PlanSchedule, TheSecondUavWaitsIfItsPathCrossesThatOfTheFirst) {
  test::PlanSite site(3, 60.0);
  const Team team(site.scenario, site.config);
  // The photographers start at y = -2 and y = 2 and go to each other's side.
  std::vector<View> views(2);
  views[0].p_WB = {2.0, 2.0, kTakeoffHeight};
  views[1].p_WB = {2.0, -2.0, kTakeoffHeight};
  views[0].kind = views[1].kind = team.kind_of[1];
  const RayScene world(site.scene.mesh);
  Legs legs(site.scenario, world, {Vector3d(10.0, -6.0, 0.0), Vector3d(26.0, 15.0, 14.0)}, team, views, site.config);
  Schedule schedule(legs, site.scenario, team, views, site.config.settle_s, site.scenario.duration_s);
  EXPECT_TRUE(schedule.add({}).moves.empty());
  const Timetable first = schedule.add({{0}, {}, 0.0}), second = schedule.add({{1}, {}, 0.0});
  ASSERT_EQ(first.views, (std::vector<std::size_t>{0}));
  ASSERT_EQ(second.views, (std::vector<std::size_t>{1}));
  EXPECT_GE(second.time_s, first.time_s + 0.5);
  const TeamKind& kind = team.kinds[team.kind_of[1]];
  for (double t = 0.0; t < site.scenario.duration_s; t += 0.05) {
    const double distance = (plan_state(kind, first.moves, t).p_WB - plan_state(kind, second.moves, t).p_WB).norm();
    ASSERT_GE(distance, Schedule::least_distance(kind, kind) - 0.1 * kind.speed) << t;
  }
}

TEST(PlanSchedule, AUavSkipsAViewThatItCannotReach) {
  test::PlanSite site(2, 60.0);
  const Team team(site.scenario, site.config);
  std::vector<View> views(3);
  views[0].p_WB = {2.0, 2.0, kTakeoffHeight};
  views[1].p_WB = {16.0, 0.0, 7.0};  // inside the block
  views[2].p_WB = {2.0, -4.0, kTakeoffHeight};
  for (View& view : views) view.kind = team.kind_of[1];
  const RayScene world(site.scene.mesh);
  Legs legs(site.scenario, world, {Vector3d(10.0, -6.0, 0.0), Vector3d(26.0, 15.0, 14.0)}, team, views, site.config);
  ASSERT_TRUE(legs.way(0, 1).empty());
  Schedule schedule(legs, site.scenario, team, views, site.config.settle_s, site.scenario.duration_s);
  schedule.add({});
  EXPECT_EQ(schedule.add({{0, 1, 2}, {}, 0.0}).views, (std::vector<std::size_t>{0, 2}));
}

}  // namespace
}  // namespace skein::sim
