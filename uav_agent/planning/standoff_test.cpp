#include "uav_agent/planning/standoff.hpp"

#include <gtest/gtest.h>

namespace skein::agent {
namespace {

/// A box whose front face is y = 0 and that reaches 12 m inwards (towards +y), with an upright strip on that face.
struct Facade {
  std::vector<OrientedBox> boxes;
  Strip strip;
  CameraReach reach = camera_reach({}, 2.0);

  Facade() {
    OrientedBox box;
    box.center = {0.0, 6.0, 30.0};
    box.size = {20.0, 12.0, 40.0};
    boxes.push_back(box);
    strip.begin_W = {0.0, 0.0, 15.0};
    strip.end_W = {0.0, 0.0, 45.0};
    strip.out_W = -Vector3d::UnitY();
    strip.across_W = Vector3d::UnitX();
    strip.half_width_m = 5.0;
    strip.inside_m = 12.0;
  }
};

/// Hits on a wall y = depth(z).
void add_wall(OccupancyMap& map, const auto& depth, std::optional<Vector3d> seen_from) {
  std::vector<Eigen::Vector3f> hits;
  for (double x = -9.0; x <= 9.0; x += 0.4) {
    for (double z = 11.0; z <= 49.0; z += 0.4) hits.emplace_back(Vector3d(x, depth(z), z).cast<float>());
  }
  map.insert(hits, seen_from);
}

TEST(Standoff, WithoutAMapTheStandoffIsFromTheFaceOfTheBox) {
  const Facade facade;
  const OccupancyMap map;
  const auto runs =
      fit_strip(facade.strip, false, 0.0, {}, FreeSpace({.clearance_m = 1.8}, facade.boxes, map), facade.reach, {});
  ASSERT_EQ(runs.size(), 1U);
  for (const Waypoint& w : runs[0].waypoints) EXPECT_NEAR(-w.p_WB.y(), 0.55 * facade.reach.sharp_distance_m, 0.3);
  EXPECT_NEAR(runs[0].waypoints.front().p_WB.z(), 15.0, 1e-9);
  EXPECT_NEAR(runs[0].waypoints.back().p_WB.z(), 45.0, 1e-9);
}

TEST(Standoff, FollowsALeaningSurfaceAtTheSharpDistance) {
  const Facade facade;
  const auto depth = [](double z) { return 1.0 + 0.15 * (z - 11.0); };
  OccupancyMap map;
  for (double z = 12.0; z <= 48.0; z += 4.0) add_wall(map, depth, Vector3d(0.0, -12.0, z));
  const auto runs =
      fit_strip(facade.strip, false, 0.0, {}, FreeSpace({.clearance_m = 1.8}, facade.boxes, map), facade.reach, {});
  ASSERT_EQ(runs.size(), 1U);
  for (const Waypoint& w : runs[0].waypoints) {
    EXPECT_NEAR(depth(w.p_WB.z()) - w.p_WB.y(), 0.92 * facade.reach.sharp_distance_m, 1.3);
    EXPECT_LT(w.speed_mps, 2.2) << "no faster than the camera allows";
  }
}

TEST(Standoff, DoesNotEnterTheBoxWhereNoUavHasLooked) {
  const Facade facade;
  OccupancyMap map;
  add_wall(
      map, [](double) { return 8.0; }, std::nullopt);  // hits alone do not prove that the way is free
  const auto runs =
      fit_strip(facade.strip, false, 0.0, {}, FreeSpace({.clearance_m = 1.8}, facade.boxes, map), facade.reach, {});
  ASSERT_FALSE(runs.empty()) << "it looks from outside the box, from farther away than intended";
  for (const auto& run : runs) {
    for (const Waypoint& w : run.waypoints) EXPECT_LT(w.p_WB.y(), -1.79);
  }
}

TEST(Standoff, LeavesOutThePartOfTheStripInAnotherBox) {
  Facade facade;
  OrientedBox roof;  // juts out over the upper part of the facade
  roof.center = {0.0, 0.0, 42.0};
  roof.size = {40.0, 40.0, 10.0};
  facade.boxes.push_back(roof);
  const OccupancyMap map;
  const auto runs =
      fit_strip(facade.strip, true, 0.0, {}, FreeSpace({.clearance_m = 1.8}, facade.boxes, map), facade.reach, {});
  ASSERT_EQ(runs.size(), 1U);
  for (const Waypoint& w : runs[0].waypoints) EXPECT_LT(w.p_WB.z(), 37.0 - 1.79);
  EXPECT_GT(runs[0].first_s, 9.0) << "reversed: it begins at the top";
}

TEST(Standoff, ContinuesFromWhereTheUavIs) {
  const Facade facade;
  const OccupancyMap map;
  const Vector3d now(0.0, -6.5, 25.0);
  const auto runs =
      fit_strip(facade.strip, false, 10.5, now, FreeSpace({.clearance_m = 1.8}, facade.boxes, map), facade.reach, {});
  ASSERT_FALSE(runs.empty());
  EXPECT_NEAR((runs[0].waypoints.front().p_WB - now).norm(), 1.0, 1.2) << "no jump to another stand-off";
}

}  // namespace
}  // namespace skein::agent
