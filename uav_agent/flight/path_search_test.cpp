#include "uav_agent/flight/path_search.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

OrientedBox upright_box(const Vector3d& centre, const Vector3d& size) {
  OrientedBox box;
  box.center = centre;
  box.size = size;
  return box;
}

/// Hits on a wall in the plane y = 0 with a window; nothing above `top`.
std::vector<Eigen::Vector3f> wall_with_window(const Vector3d& window, double half_width, double top) {
  std::vector<Eigen::Vector3f> hits;
  for (double x = -40.0; x <= 40.0; x += 0.4) {
    for (double z = 0.4; z <= top; z += 0.4) {
      if (std::abs(x - window.x()) < half_width && std::abs(z - window.z()) < half_width) continue;
      hits.emplace_back(Eigen::Vector3d(x, 0.0, z).cast<float>());
    }
  }
  return hits;
}

void expect_free(const FreeSpace& space, const Vector3d& from, const std::vector<Vector3d>& corners) {
  Vector3d at = from;
  for (const Vector3d& corner : corners) {
    const int steps = 1 + static_cast<int>((corner - at).norm() / 0.2);
    for (int i = 0; i <= steps; ++i) {
      const Vector3d p = at + (corner - at) * (static_cast<double>(i) / steps);
      // The search checks cells and the middles between them. Elsewhere, the path may be slightly nearer to structure.
      EXPECT_FALSE(space.map().any_occupied_within(p, space.config().clearance_m - 0.4)) << p.transpose();
    }
    at = corner;
  }
}

TEST(PathSearch, GoesStraightWhereNothingIsInTheWay) {
  const std::vector<OrientedBox> boxes;
  const OccupancyMap map;
  const auto path = find_path(FreeSpace({}, boxes, map), boxes, {0.0, 0.0, 10.0}, {50.0, 20.0, 30.0});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->size(), 1U);
}

TEST(PathSearch, FindsTheWindowInAWall) {
  OccupancyMap map;
  map.insert(wall_with_window({12.0, 0.0, 10.0}, 4.5, 30.0), std::nullopt);
  const std::vector<OrientedBox> boxes;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  const Vector3d from(-5.0, -15.0, 10.0), to(-5.0, 15.0, 10.0);
  const auto path = find_path(space, boxes, from, to);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->back(), to);
  expect_free(space, from, *path);
  EXPECT_LT(path_length(from, *path), 60.0) << "the path leads through the window, not around the wall";
}

TEST(PathSearch, GoesAroundUnknownBoxes) {
  const std::vector<OrientedBox> boxes = {upright_box({0.0, 0.0, 20.0}, {40.0, 10.0, 40.0})};
  const OccupancyMap map;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  const Vector3d from(0.0, -12.0, 12.0), to(0.0, 12.0, 12.0);
  const auto path = find_path(space, boxes, from, to);
  ASSERT_TRUE(path);
  Vector3d at = from;
  for (const Vector3d& corner : *path) {
    for (double t = 0.0; t <= 1.0; t += 0.02) EXPECT_FALSE(boxes[0].contains(at + t * (corner - at), 1.2));
    at = corner;
  }
}

TEST(PathSearch, ReportsThatThereIsNoPath) {
  const std::vector<OrientedBox> boxes = {upright_box({0.0, 0.0, 20.0}, {20.0, 20.0, 40.0})};
  const OccupancyMap map;
  const FreeSpace space({}, boxes, map);
  EXPECT_FALSE(find_path(space, boxes, {30.0, 0.0, 10.0}, {0.0, 0.0, 10.0})) << "the goal lies in an unknown box";
  EXPECT_FALSE(find_path(space, boxes, {30.0, 0.0, 10.0}, {40.0, 0.0, 1.0})) << "the goal lies too low";
}

TEST(PathSearch, GoesAsNearAsPossibleToAGoalThatCannotBeReached) {
  constexpr double kWorthM = 3.0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    RandomStream random(i, "approach", 0);
    const std::vector<OrientedBox> boxes = {
        upright_box({random.uniform(-5, 5), random.uniform(-5, 5), 20.0}, {20, 20, 40})};
    const OccupancyMap map;
    const FreeSpace space({}, boxes, map);
    const Vector3d goal = boxes[0].center - Vector3d(0.0, 0.0, 10.0);
    const double heading = random.uniform(0.0, 6.28);
    const Vector3d from(40.0 * std::cos(heading), 40.0 * std::sin(heading), 10.0);
    ASSERT_FALSE(find_path(space, boxes, from, goal));
    const auto path = find_approach(space, boxes, from, goal, kWorthM);
    ASSERT_TRUE(path) << "case " << i;
    const Vector3d end = path->back();
    EXPECT_TRUE(space.free(end));
    EXPECT_LT((end - goal).norm(), 17.0) << "the path ends just beside the box";
    EXPECT_FALSE(find_approach(space, boxes, end, goal, kWorthM))
        << "case " << i << ": it is already as near as possible";
  }
}

TEST(PathSearch, LeavesAPlaceThatIsTooNearToStructure) {
  OccupancyMap map;
  map.insert(wall_with_window({100.0, 0.0, 0.0}, 1.0, 30.0), std::nullopt);
  const std::vector<OrientedBox> boxes;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  const Vector3d from(0.0, -1.2, 10.0), to(5.0, -20.0, 10.0);
  ASSERT_FALSE(space.free(from));
  const auto path = find_path(space, boxes, from, to);
  ASSERT_TRUE(path);
  EXPECT_GT(map.distance_to_occupied(path->front(), 10.0).value_or(10.0), 1.2);
}

TEST(PathSearch, IsRepeatableAndBounded) {
  RandomStream random(3, "clutter", 0);
  std::vector<Eigen::Vector3f> clutter;
  for (int i = 0; i < 4000; ++i) {
    clutter.emplace_back(Vector3d(random.uniform(-30, 30), random.uniform(-8, 8), random.uniform(2, 40)).cast<float>());
  }
  OccupancyMap map;
  map.insert(clutter, std::nullopt);
  const std::vector<OrientedBox> boxes;
  const FreeSpace space({.clearance_m = 1.5}, boxes, map);
  const Vector3d from(0.0, -20.0, 15.0), to(3.0, 20.0, 15.0);
  const auto once = find_path(space, boxes, from, to), again = find_path(space, boxes, from, to);
  ASSERT_TRUE(once);
  EXPECT_EQ(*once, *again);
  EXPECT_FALSE(find_path(space, boxes, from, to, {.cell_m = 2.0, .max_expansions = 3}));
}

}  // namespace
}  // namespace skein::agent
