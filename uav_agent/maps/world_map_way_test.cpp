// Tests of WorldMap::clear_way_m(). Its result must be that of a check of each sample along the way.
#include <gtest/gtest.h>

#include <vector>

#include "core/math/normals.hpp"
#include "core/math/random_stream.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {
namespace {

TEST(WorldMapWay, IsClearUpToTheFirstCubeThatIsOccupied) {
  WorldMap map({});
  EXPECT_EQ(map.clear_way_m({0.25, 0.25, 0.25}, Vector3d::UnitX(), 20.0), 20.0);
  map.insert({}, std::vector{Eigen::Vector3f(7.3F, 0.3F, 0.2F)});
  EXPECT_NEAR(map.clear_way_m({0.25, 0.25, 0.25}, Vector3d::UnitX(), 20.0), 6.75, 0.25);
  EXPECT_EQ(map.clear_way_m({0.25, 0.25, 0.25}, Vector3d::UnitX(), 5.0), 5.0);
  EXPECT_EQ(map.clear_way_m({0.25, 0.75, 0.25}, Vector3d::UnitX(), 20.0), 20.0) << "the way passes beside the cube";
  EXPECT_EQ(map.clear_way_m({7.25, 0.25, 0.25}, Vector3d::UnitX(), 20.0), 0.0) << "the way begins inside the cube";
}

/// clear_way_m() passes over chunks without structure. That must not change the result, not even by rounding.
TEST(WorldMapWay, IsClearAsFarAsACheckOfEachSampleFinds) {
  RandomStream random(9, "world_map_way_test", 0, 0);
  for (const double cell_m : {0.5, 0.3}) {
    WorldMap map({.cell_m = cell_m, .distance_reach_m = 8.0 * cell_m});
    std::vector<Eigen::Vector3f> hits_W;
    for (int i = 0; i < 150; ++i) {
      hits_W.emplace_back(
          Vector3d(random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-10, 10)).cast<float>());
    }
    map.insert({}, hits_W);
    for (int i = 0; i < 30; ++i) map.doubt(map.cube_of(hits_W[static_cast<std::size_t>(i)].cast<double>()));
    int met = 0;
    for (int i = 0; i < 20'000; ++i) {
      Vector3d from_W(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-10, 10));
      Vector3d direction_W = normals(random).normalized();
      if (i % 3 == 0) direction_W = (hits_W[static_cast<std::size_t>(i % 150)].cast<double>() - from_W).normalized();
      if (i % 7 == 0) from_W = (from_W / (4.0 * cell_m)).array().round() * 4.0 * cell_m;  // on a plane between chunks
      if (i % 5 == 0) direction_W = Vector3d::Unit(i % 15 / 5) * (i % 2 == 0 ? 1.0 : -1.0);
      const double reach_m = i % 4 == 0 ? 100.0 : random.uniform(0.0, 60.0);
      double expected_m = reach_m;
      for (int sample = 0; 0.5 * cell_m * sample < reach_m && expected_m == reach_m; ++sample) {
        const double way_m = sample * (0.5 * cell_m);
        const Eigen::Vector3i cube = map.cube_of(from_W + way_m * direction_W);
        if (map.known(cube).space == Space::occupied && !map.doubted(cube)) expected_m = way_m;
      }
      ASSERT_EQ(map.clear_way_m(from_W, direction_W, reach_m), expected_m) << i;
      met += expected_m < reach_m;
    }
    EXPECT_GT(met, 1000);
  }
}

}  // namespace
}  // namespace skein::agent
