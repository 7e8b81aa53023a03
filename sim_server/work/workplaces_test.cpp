// Checks each workplace with rays and the camera, in random worlds.
#include "sim_server/work/workplaces.hpp"

#include <gtest/gtest.h>

#include "core/scenario/scenario_reader.hpp"
#include "scenes/wild/world.hpp"
#include "sight/ray_scene.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

TEST(Workplaces, WorkplacesKeepTheirClearanceAndShowTheirPointsInRandomWorlds) {
  for (const std::uint64_t seed : {104u, 151u}) {
    const World world = draw_world("wild", seed, source_path("config"));
    const Workplaces places(world.scenario, world.scene);
    const RayScene rays(world.scene.mesh);
    std::size_t found = 0;
    for (std::size_t i = 0; i < world.scene.points.size(); ++i) {
      const Workplace& place = places.of(UavIndex{0})[i];
      if (place.q == 0.0) continue;
      ++found;
      const InterestPoint& point = world.scene.points[i];
      const Vector3d p_W = point.p_W.cast<double>();
      EXPECT_GE(rays.clearance(place.p_W), Workplaces::kBerth);
      EXPECT_GE(place.q, Workplaces::kLeastQ);
      EXPECT_FALSE(rays.first_hit_distance(place.p_W, p_W + 0.05 * (place.p_W - p_W).normalized(), {.ground = false}));
    }
    EXPECT_GT(3 * found, world.scene.points.size()) << "every wild world has workplaces for a third of its points";
  }
}

TEST(Workplaces, NoWorkplaceIsInsideAClosedBoxOrBelowTheGround) {
  Scenario scenario;
  scenario.fleet.push_back({.name = "a", .vehicle = load_vehicle("photographer", source_path("config"))});
  Scene scene;
  test::add_box(scene.mesh, {0, 0, 15}, {30, 30, 30});
  scene.points.push_back({{14.9F, 0, 15}, {-1, 0, 0}});  // inside
  scene.points.push_back({{0, 0, 0.5F}, {0, 0, -1}});
  scene.points.push_back({{15, 0, 15}, {1, 0, 0}});  // on the outer side
  const Workplaces places(scenario, scene);
  EXPECT_EQ(places.of(UavIndex{0})[0].q, 0.0);
  EXPECT_EQ(places.of(UavIndex{0})[1].q, 0.0);
  EXPECT_GT(places.of(UavIndex{0})[2].q, 0.5);
}

}  // namespace
}  // namespace skein::sim
