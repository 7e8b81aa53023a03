#include "uav_agent/flight/free_space.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

OrientedBox unit_box() {
  OrientedBox box;
  box.center = {0.0, 0.0, 20.0};
  box.size = {10.0, 10.0, 10.0};
  return box;
}

/// A scan from 20 m above the box. Each ray passes through the space above `height`, and hits at this height.
OccupancyMap seen_from_above(double height) {
  OccupancyMap::Config config;
  config.max_free_rays = 100'000;
  OccupancyMap map(config);
  std::vector<Eigen::Vector3f> hits;
  for (double x = -12.0; x <= 12.0; x += 0.25) {
    for (double y = -12.0; y <= 12.0; y += 0.25) {
      hits.emplace_back(Eigen::Vector3d(x, y, height).cast<float>());
    }
  }
  map.insert(hits, Vector3d(0.0, 0.0, 45.0));
  return map;
}

TEST(FreeSpace, UnseenSpaceIsFreeOnlyBeyondTheJutOfABox) {
  const std::vector<OrientedBox> boxes = {unit_box()};
  const OccupancyMap nothing;
  const FreeSpace space({.clearance_m = 1.8, .jut_m = 3.0}, boxes, nothing);
  const FreeSpace to_clearance({.clearance_m = 1.8, .jut_m = 0.0}, boxes, nothing);
  for (const double beyond : {0.5, 1.7, 1.9, 2.9, 3.1, 8.0}) {
    for (const Vector3d& out : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitZ())}) {
      const Vector3d p = boxes[0].center + (5.0 + beyond) * out;
      EXPECT_EQ(space.free(p), beyond > 3.0) << beyond;
      EXPECT_EQ(to_clearance.free(p), beyond > 1.8) << beyond;
    }
  }
}

TEST(FreeSpace, SpaceThatRaysPassedMayBeEnteredUpToTheClearance) {
  const std::vector<OrientedBox> boxes = {unit_box()};
  const OccupancyMap map = seen_from_above(18.0);
  const FreeSpace space({.clearance_m = 1.8, .jut_m = 3.0}, boxes, map);
  EXPECT_TRUE(space.free({0.0, 0.0, 27.0})) << "beside the box";
  EXPECT_TRUE(space.free({0.0, 0.0, 24.0})) << "in the box";
  EXPECT_FALSE(space.free({0.0, 0.0, 19.5})) << "too near to what was hit";
  EXPECT_FALSE(space.free({0.0, 0.0, 15.5})) << "behind what was hit";
}

/// A wall in the plane x = 0 that another UAV reported.
WorldMap wall() {
  WorldMap map({.ground_m = 0.3});
  for (int y = -20; y < 20; ++y) {
    for (int z = 4; z < 60; ++z) map.hear({0, y, z}, 0, Space::occupied, kOwn + 1);
  }
  return map;
}

TEST(FreeSpace, AWayOutComesNoNearerToStructure) {
  const WorldMap world = wall();
  const OccupancyMap nothing;
  const std::vector<OrientedBox> boxes;
  const FreeSpace space({.clearance_m = 2.0, .world = &world}, boxes, nothing);
  RandomStream random(5, "way out", 0);
  int out = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d from_W(random.uniform(0.8, 2.3), random.uniform(-5.0, 5.0), random.uniform(8.0, 20.0));
    const Vector3d to_W = from_W + Vector3d(random.uniform(-6.0, 6.0), random.uniform(-3, 3), random.uniform(-3, 3));
    const bool leads_out = space.leads_out(from_W, to_W);
    const double nearer_m = from_W.x() - to_W.x();
    if (nearer_m < -0.1) {
      EXPECT_TRUE(leads_out) << "the way leads away from the wall";
    }
    if (nearer_m > 1.0) {
      EXPECT_FALSE(leads_out) << "the way leads towards the wall, or through it";
    }
    out += leads_out ? 1 : 0;
  }
  EXPECT_GT(out, 100);
}

TEST(FreeSpace, NoWayOutComesNearerToAnotherUavThanIsAllowed) {
  const WorldMap world = wall();
  const OccupancyMap nothing;
  const std::vector<OrientedBox> boxes;
  const FreeSpace::Config config{.clearance_m = 2.5, .world = &world};
  RandomStream random(7, "balls", 0);
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d from_W(random.uniform(0.8, 2.3), random.uniform(-5.0, 5.0), random.uniform(8.0, 20.0));
    const Vector3d way = Vector3d(random.uniform(0.0, 6.0), random.uniform(-3, 3), random.uniform(-3, 3));
    const Vector3d off = Vector3d(random.uniform(-2, 4), random.uniform(-2, 2), random.uniform(-2, 2));
    const Sphere ball{from_W + off, 0.9 * off.norm()};
    const bool leads_out = FreeSpace(config, boxes, nothing, {ball}).leads_out(from_W, from_W + way);
    const double along = std::clamp(off.dot(way) / way.squaredNorm(), 0.0, 1.0);
    const double nearest_m = (off - along * way).norm();
    if (nearest_m < ball.radius_m - 0.3) {
      EXPECT_FALSE(leads_out);
      ++refused;
    } else if (nearest_m >= ball.radius_m) {
      EXPECT_EQ(leads_out, FreeSpace(config, boxes, nothing).leads_out(from_W, from_W + way));
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(FreeSpace, WithAMapOfAllBeamsUnknownSpaceIsFreeUnlessProofIsRequired) {
  WorldMap world = wall();
  world.set_free({10.0, 0.0, 10.0}, 4.0);
  const OccupancyMap nothing;
  const std::vector<OrientedBox> boxes = {unit_box()};
  BodyFit fit(1.5, 1.0);
  fit.update(world, 0);
  FreeSpace::Config config{.clearance_m = 2.0, .world = &world, .unknown_cost = 1.5, .fit = &fit};
  const Vector3d proved_W(10.0, 0.0, 10.0), unknown_W(10.0, 15.0, 10.0), near_W(1.5, 0.0, 10.0);
  for (const bool proved_only : {false, true}) {
    config.proved_only = proved_only;
    const FreeSpace space(config, boxes, nothing);
    EXPECT_TRUE(space.free(proved_W));
    EXPECT_EQ(space.free(unknown_W), !proved_only);
    EXPECT_FALSE(space.free(near_W)) << "too near to the wall";
    EXPECT_EQ(space.free({4.0, 0.0, 20.0}), !proved_only) << "with this map, boxes do not count";
    EXPECT_EQ(space.cost(proved_W), 1.0);
    EXPECT_EQ(space.cost(unknown_W), 1.5);
  }
}

}  // namespace
}  // namespace skein::agent
