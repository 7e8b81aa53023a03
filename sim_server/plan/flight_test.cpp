// Plans can be flown: in the simulation, their score is about the planned one, and no UAV collides.
#include <gtest/gtest.h>

#include "scenes/scene_source.hpp"
#include "sim_server/plan/plan.hpp"
#include "sim_server/testing/plan_site.hpp"

namespace skein::sim {
namespace {

TEST(PlanFlown, APlanForASmallSiteScoresAsPlanned) {
  const test::PlanSite site(3, 60.0);
  const Plan plan = make_plan(site.scenario, site.scene, site.config);
  const PlanFlight flown = fly_plan(site.scenario, site.scene, site.config, plan);
  EXPECT_EQ(flown.collisions, 0u);
  EXPECT_GE(flown.score, 0.95 * plan.score);
  EXPECT_LT(flown.astray_m, site.config.margin_m);
  EXPECT_EQ(fly_plan(site.scenario, site.scene, site.config, plan), flown);
  Scenario harsh = site.scenario;
  harsh.conditions = conditions_preset("harsh");
  EXPECT_EQ(fly_plan(harsh, site.scene, site.config, plan), flown) << "an estimate is that of an ideal world";
}

/// Only a third of the mission, so that search and flight take less time.
TEST(PlanFlown, APlanForTheTowersScoresAsPlanned) {
  Scenario scenario = load_scenario(source_path("config/scenarios/towers.yaml"));
  scenario.duration_s = 200.0;
  const Scene scene = load_scene(scenario);
  PlanConfig config;
  config.rounds = 0;
  config.most_views = 2000;
  const Plan plan = make_plan(scenario, scene, config);
  const PlanFlight flown = fly_plan(scenario, scene, config, plan);
  EXPECT_EQ(flown.collisions, 0u);
  EXPECT_GE(flown.score, 0.9 * plan.score);
  EXPECT_GT(plan.score, 0.4 * static_cast<double>(scene.points.size()));
}

}  // namespace
}  // namespace skein::sim
