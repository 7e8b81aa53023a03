// Tests of ClearWays: its answers must be those of WorldMap::clear_way_m(), bit for bit.
#include "uav_agent/maps/clear_ways.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/math/normals.hpp"
#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

TEST(ClearWays, AreAsClearAsTheMapFinds) {
  constexpr double kMostM = 30.0;
  RandomStream random(3, "clear_ways_test", 0, 0);
  for (const double cell_m : {0.5, 0.3}) {
    WorldMap map({.cell_m = cell_m, .distance_reach_m = 8.0 * cell_m});
    ClearWays ways;
    int met = 0;
    for (int scan = 0; scan < 40; ++scan) {
      const Vector3d about_W(random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-10, 10));
      std::vector<Eigen::Vector3f> hits_W;
      for (int i = 0; i < 10; ++i) hits_W.emplace_back((about_W + 2.0 * normals(random)).cast<float>());
      map.insert({}, hits_W);
      const auto place_W = [&](std::size_t i) -> Vector3d { return hits_W[i].cast<double>(); };
      for (std::size_t i = 0; i < 3; ++i) map.doubt(map.cube_of(place_W(i)));
      for (std::size_t i = 2; i < 6; ++i) map.vacate(place_W(i), 0.1);
      if (scan % 4 == 0) map.vacate(about_W, 8.0);  // no cube of some chunks is occupied any more
      ways.begin(map, kMostM);
      Vector3d from_W(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-10, 10));
      if (scan % 3 == 0) from_W = (from_W / (4.0 * cell_m)).array().round() * 4.0 * cell_m;  // a corner of a chunk
      if (scan % 5 == 0) from_W = place_W(9);                                                // within structure
      for (int i = 0; i < 1000; ++i) {
        Vector3d direction_W = normals(random).normalized();
        if (i % 3 == 0) direction_W = (place_W(static_cast<std::size_t>(i % 10)) - from_W).normalized();
        if (i % 5 == 0) direction_W = Vector3d::Unit(i % 15 / 5) * (i % 2 == 0 ? 1.0 : -1.0);
        if (i % 7 == 0) direction_W = Vector3d(1.0, i % 2 == 0 ? 1.0 : -1.0, random.uniform(-1, 1)).normalized();
        if (!(direction_W.squaredNorm() > 0.5)) continue;  // from the hit itself
        const double reach_m = i % 4 == 0 ? 100.0 : random.uniform(0.0, 60.0);
        const double within_m = map.clear_way_m(from_W, direction_W, std::min(reach_m, kMostM));
        const double expected_m = within_m < std::min(reach_m, kMostM) ? within_m : reach_m;
        ASSERT_EQ(ways.clear_way_m(from_W, direction_W, reach_m), expected_m) << scan << ", " << i;
        met += expected_m < reach_m;
        if (i % 50 == 0) from_W += 0.03 * normals(random);  // the LiDAR moves during a scan
      }
    }
    EXPECT_GT(met, 1000);
  }
}

}  // namespace
}  // namespace skein::agent
