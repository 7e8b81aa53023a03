#include "scenes/district.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"
#include "sight/ray_scene.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

World drawn_district(std::uint64_t seed, std::size_t uavs) { return draw_district(seed, uavs, source_path("config")); }

TEST(District, EveryUavHasItsPlaceAndEveryLotItsBuilding) {
  RandomStream draw(1, "district_test", 0);
  for (int i = 0; i < 6; ++i) {
    const auto seed = static_cast<std::uint64_t>(draw.uniform() * 1e6);
    const auto uavs = 1 + static_cast<std::size_t>(draw.uniform() * 60.0);
    const World world = drawn_district(seed, uavs);
    const Scenario& scenario = world.scenario;
    const std::size_t lots = (uavs + 4) / 5;
    SCOPED_TRACE(scenario.name);
    ASSERT_EQ(scenario.fleet.size(), uavs);
    ASSERT_EQ(world.scene.boxes.size(), lots);
    EXPECT_GE(world.scene.points.size(), 250 * lots);
    EXPECT_EQ(test::open_edges(world.scene.mesh), "");
    EXPECT_EQ(test::inward_parts(world.scene.mesh), "");
    for (const InterestPoint& point : world.scene.points) {
      const auto holds = [&](const OrientedBox& box) { return box.contains(point.p_W.cast<double>()); };
      ASSERT_EQ(std::ranges::count_if(world.scene.boxes, holds), 1);
    }
    const RayScene rays(world.scene.mesh);
    EXPECT_GT(rays.clearance(scenario.station_position, 5.0), 2.0);
    for (std::size_t a = 0; a < uavs; ++a) {
      const Vector2d start_W = scenario.fleet[a].start;
      EXPECT_GT(rays.clearance({start_W.x(), start_W.y(), 1.0}, 5.0), 0.9) << a;
      EXPECT_FALSE(rays.first_hit({start_W.x(), start_W.y(), 0.3}, Vector3d::UnitZ(), 50.0, {.ground = false})) << a;
      for (std::size_t b = 0; b < a; ++b) EXPECT_GT((start_W - scenario.fleet[b].start).norm(), 4.0);
    }
  }
}

TEST(District, ALargerFleetHasTheSameFirstLots) {
  const World small = drawn_district(3, 5), large = drawn_district(3, 17);
  ASSERT_EQ(large.scene.boxes.size(), 4U);
  EXPECT_EQ(small.scene.boxes[0].center, large.scene.boxes[0].center);
  EXPECT_EQ(drawn_district(3, 17).scene.points.size(), large.scene.points.size());
  EXPECT_NE(drawn_district(4, 5).scene.boxes[0].center, small.scene.boxes[0].center);
}

}  // namespace
}  // namespace skein::sim
