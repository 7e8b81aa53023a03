// The antenna rule's corners; its counts are checked by sim_server/golden/check_test.cpp.
#include "sim_server/sensors/antenna_link.hpp"

#include <gtest/gtest.h>

#include "sim_server/sensors/sight_memory.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// An endless wall across x.
auto wall_at(double x) {
  return [x](const Vector3d& from, const Vector3d& to) -> std::optional<double> {
    const double share = (x - from.x()) / (to.x() - from.x());
    if (share < 0.0 || share > 1.0) return std::nullopt;
    return share * (to - from).norm();
  };
}

const AntennaNode kLeftNode{{0, 0, 5}, 0.2}, kRightNode{{20, 0, 5}, 0.1};

TEST(AntennaLink, AFreeLineOfSightIsALinkAndTakesOneRay) {
  int rays = 0;
  const auto link = trace_link(kLeftNode, kRightNode, [&](const Vector3d&, const Vector3d&) -> std::optional<double> {
    ++rays;
    return std::nullopt;
  });
  EXPECT_TRUE(link.linked);
  EXPECT_EQ(link.range, 20.0);
  EXPECT_EQ(rays, 1);
}

TEST(AntennaLink, AWallBlocksTheLinkAndTheRangeIsStillKnown) {
  const auto link = trace_link(kLeftNode, kRightNode, wall_at(10));
  EXPECT_FALSE(link.linked);
  EXPECT_EQ(link.range, 20.0);
}

TEST(AntennaLink, AWallRightBeforeOneEndBlocksTheLinkInOneOrderOfTheNodesOnly) {
  const auto wall = wall_at(19.85);
  EXPECT_TRUE(trace_link(kLeftNode, kRightNode, wall).linked);
  EXPECT_FALSE(trace_link(kRightNode, kLeftNode, wall).linked);
}

TEST(AntennaLink, OneFreePairOfThirtySixSuffices) {
  const auto lid = [](const Vector3d& from, const Vector3d& to) -> std::optional<double> {
    if (from.z() > 5.15 && to.z() > 5.05) return std::nullopt;
    return 1.0;
  };
  EXPECT_TRUE(trace_link(kLeftNode, kRightNode, lid).linked);
  EXPECT_EQ(count_sight_lines(kLeftNode, kRightNode, lid).clear, 1);
}

TEST(AntennaLink, EachNodeHasOneAntennaOnEachOfItsSidesAndAnyOfThemSuffices) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3d offset = side * Vector3d::Unit(axis);
      const Vector3d from = kLeftNode.p_W + kLeftNode.offset_m * offset,
                     to = kRightNode.p_W + kRightNode.offset_m * offset;
      const auto only_there = [&](const Vector3d& a, const Vector3d& b) -> std::optional<double> {
        if ((a - from).norm() < 1e-9 && (b - to).norm() < 1e-9) return std::nullopt;
        return 1.0;
      };
      EXPECT_EQ(count_sight_lines(kLeftNode, kRightNode, only_there).clear, 1) << side << " on axis " << axis;
      EXPECT_TRUE(trace_link(kLeftNode, kRightNode, only_there).linked) << side << " on axis " << axis;
    }
  }
}

TEST(AntennaLink, OnlyTheLowestAntennaIsKeptAboveGround) {
  const auto points = antennas({{3, 4, 0.05}, 0.2});
  EXPECT_DOUBLE_EQ(points[5].z(), 0.1);
  EXPECT_DOUBLE_EQ(points[0].z(), 0.05);
  EXPECT_DOUBLE_EQ(points[4].z(), 0.25);
}

/// One node stays at its place; the other flies through clutter, and jumps to another place now and then.
TEST(AntennaLink, SightMemoryGivesTheSameAnswersAsRaysAlone) {
  RandomStream random(1, "antenna_link_test", 0, 0);
  int linked = 0, blocked = 0;
  for (const std::size_t triangles : {40U, 150U}) {
    RayScene world(test::random_triangles(triangles, triangles), {body_shape(VehicleConfig{})});
    for (int flight = 0; flight < 8; ++flight) {
      const auto place = [&] { return test::random_in_box(random, {-25.0, -25.0, 0.0}, {25.0, 25.0, 20.0}); };
      const Vector3d start = place(), end = place(), station = place();
      SightMemory memory;
      for (int step = 0; step <= 200; ++step) {
        const AntennaNode a{station, 0.2};
        const AntennaNode b{step % 20 == 19 ? place() : Vector3d(start + 0.005 * step * (end - start)), 0.1};
        world.set_pose(UavIndex{0}, Isometry3d(Eigen::Translation3d(0.5 * (a.p_W + b.p_W))));
        const RayFilter filter{.except_uav = step % 2 == 0 ? UavIndex{0} : kNoUav};
        const bool expected = trace_link(a, b, [&](const Vector3d& p, const Vector3d& q) {
                                return world.first_hit_distance(p, q, filter);
                              }).linked;
        ASSERT_EQ(memory.linked(a, b, world, filter), expected) << "flight " << flight << " step " << step;
        (expected ? linked : blocked) += 1;
      }
    }
  }
  EXPECT_GT(linked, 500);
  EXPECT_GT(blocked, 500);
}

/// Many UAVs among triangles, from the ground up. Only bodies near a line of sight are tested.
TEST(AntennaLink, AmongManyUavsLinksAreAsIfAllBodiesWereTested) {
  RandomStream random(2, "antenna_link_test", 0, 0);
  constexpr std::size_t kCrowd = 70;
  RayScene world(test::random_triangles(30, 1), std::vector<BodyShape>(kCrowd, body_shape(VehicleConfig{})));
  int linked = 0, blocked = 0;
  for (int round = 0; round < 10; ++round) {
    std::vector<AntennaNode> nodes;
    for (const UavIndex i : FirstUavs(kCrowd)) {
      const double low = round % 2 == 0 ? 0.0 : -0.5, high = round < 5 ? 0.5 : 8.0;
      nodes.push_back({test::random_in_box(random, {-8.0, -8.0, low}, {8.0, 8.0, high}), 0.1 + 0.002 * double(i)});
      world.set_pose(i, Isometry3d(Eigen::Translation3d(nodes.back().p_W)));
    }
    std::vector<UavIndex> about;
    for (const UavIndex i : FirstUavs(kCrowd)) {
      for (const UavIndex j : FirstUavs(i)) {
        RayFilter filter{.except_uav = i, .except_other_uav = j};
        const auto ray = [&](const Vector3d& p, const Vector3d& q) { return world.first_hit_distance(p, q, filter); };
        const bool expected = trace_link(nodes[i], nodes[j], ray).linked;
        const double reach = std::max(antenna_reach(nodes[i]), antenna_reach(nodes[j]));
        world.body_spheres().about(nodes[i].p_W, nodes[j].p_W, reach, about);
        filter.among = about;
        ASSERT_EQ(SightMemory().linked(nodes[i], nodes[j], world, filter), expected) << round << " " << i << " " << j;
        (expected ? linked : blocked) += 1;
      }
    }
  }
  EXPECT_GT(linked, 1000);
  EXPECT_GT(blocked, 300);
}

}  // namespace
}  // namespace skein::sim
