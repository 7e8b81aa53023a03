#include "uav_agent/planning/viewpoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

VoxelGrid scattered(double share) {
  VoxelGrid grid(Isometry3d::Identity(), {20, 20, 10}, 1.0);
  RandomStream random(7, "grid", 0);
  for (Id id = 0; id < grid.count(); ++id) {
    if (random.uniform() < share) grid.raise(id, VoxelState::occupied);
  }
  return grid;
}

/// Marches along the segment in millimetres; corners that are only grazed count neither way.
bool sees_by_marching(const VoxelGrid& grid, const Vector3d& a, const Vector3d& b) {
  const auto from = grid.at(a), to = grid.at(b);
  const int steps = static_cast<int>((b - a).norm() / 0.001);
  for (int i = 0; i <= steps; ++i) {
    const auto id = grid.at(Vector3d(a + (b - a) * (static_cast<double>(i) / std::max(1, steps))));
    if (id && id != from && id != to && grid.state(*id) == VoxelState::occupied) return false;
  }
  return true;
}

TEST(Viewpoints, RingsAroundBoxesKeepTheStandoffAndGoDown) {
  const OrientedBox tall{"tall", {10.0, -5.0, 12.0}, {6.0, 4.0, 20.0}, rotation_z(0.7)};
  const OrientedBox flat{"flat", {-20.0, 0.0, 1.0}, {5.0, 5.0, 2.0}};
  const std::vector<BoxView> views = rings_around({tall, flat}, 4.0, 6.0);
  ASSERT_EQ(views.size(), 16U) << "three rings around the tall box, one around the flat one";
  for (std::size_t i = 0; i < views.size(); ++i) {
    const OrientedBox& box = i < 12 ? tall : flat;
    const Vector3d p_O = box.R_WO.transpose() * (views[i].p_W - box.center);
    EXPECT_NEAR(std::abs(p_O.x()), 0.5 * box.size.x() + 4.0, 1e-9) << i;
    EXPECT_NEAR(std::abs(p_O.y()), 0.5 * box.size.y() + 4.0, 1e-9) << i;
    const Vector3d half = 0.5 * box.size, nearest_O = p_O.cwiseMax(-half).cwiseMin(half);
    EXPECT_LT((box.center + box.R_WO * nearest_O - views[i].nearest_W).norm(), 1e-9) << i;
    const double up_m = i == 0 || i == 12 ? -1.0 : views[i].p_W.z() - views[i - 1].p_W.z();
    EXPECT_TRUE(i % 4 == 0 ? up_m < 0.0 : up_m == 0.0) << i;
  }
}

TEST(Viewpoints, VisibilityAgreesWithMarchingAlongTheSegment) {
  const VoxelGrid grid = scattered(0.08);
  RandomStream random(7, "places", 0);
  int visible = 0, hidden = 0, differing = 0;
  for (int i = 0; i < 150; ++i) {
    const Vector3d from(random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 10)),
        to(random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 10));
    const bool seen = grid.sees(from, to);
    ++(seen ? visible : hidden);
    differing += seen != sees_by_marching(grid, from, to);
  }
  EXPECT_GT(visible, 20);
  EXPECT_GT(hidden, 20);
  EXPECT_LE(differing, 1) << "a ray may pass a corner within less than a millimetre";
}

TEST(Viewpoints, TargetsMustBeInRangeInTheImageAndUnhidden) {
  VoxelGrid grid(Isometry3d::Identity(), {20, 20, 10}, 1.0);
  grid.raise(*grid.at(Vector3d(10.5, 14.5, 5.5)), VoxelState::occupied);
  const Vector3d from(10.5, 10.5, 5.5);
  const std::vector<Vector3d> targets = {{14.5, 10.5, 5.5}, {6.5, 10.5, 5.5},  {14.5, 13.0, 5.5},
                                         {10.5, 17.5, 5.5}, {19.5, 10.5, 5.5}, {12.0, 10.5, 9.5}};
  const ViewLimits camera{8.0, 40.0 * kRadPerDeg, 30.0 * kRadPerDeg};
  EXPECT_EQ(visible_targets(grid, from, 0.0, 0.0, targets, camera), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(visible_targets(grid, from, 0.0, -60.0 * kRadPerDeg, targets, camera), std::vector<std::size_t>{5});
  EXPECT_EQ(visible_targets(grid, from, 0.0, 0.0, targets, ViewLimits{8.0}), (std::vector<std::size_t>{0, 1, 2, 5}))
      << "all around, but one is hidden and one is far";
}

TEST(Viewpoints, RingsHaveTheirRadii) {
  const Vector3d target(1.0, 2.0, 3.0);
  const RingConfig rings{.inner_m = 2.0, .outer_m = 6.0, .rings = 3, .directions = 8, .heights_m = {0.0, 1.0}};
  const auto places = ring_around(target, rings);
  ASSERT_EQ(places.size(), 48U);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR((places[i] - target).head<2>().norm(), 2.0 + 2.0 * static_cast<double>(i / 16), 1e-12);
  }
}

TEST(Viewpoints, PlacesOfAClusterAreNearItsFirstAndInItsSight) {
  const VoxelGrid grid = scattered(0.1);
  RandomStream random(7, "places", 0);
  std::vector<Vector3d> places;
  for (int i = 0; i < 120; ++i)
    places.emplace_back(random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 10));
  const auto clusters = visibility_clusters(grid, places, 5.0);
  std::set<std::size_t> all;
  for (const auto& cluster : clusters) {
    for (const std::size_t i : cluster) {
      EXPECT_TRUE(all.insert(i).second) << "each place is in one cluster only";
      EXPECT_LE((places[i] - places[cluster[0]]).norm(), 5.0);
      EXPECT_TRUE(grid.sees(places[cluster[0]], places[i]));
    }
  }
  EXPECT_EQ(all.size(), places.size());
  EXPECT_LT(clusters.size(), places.size());
}

/// Tries every combination.
double shortest_by_force(const Vector3d& from_W, const std::vector<std::vector<Vector3d>>& options, std::size_t stop) {
  if (stop == options.size()) return 0.0;
  double shortest = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : options[stop]) {
    shortest = std::min(shortest, (p - from_W).norm() + shortest_by_force(p, options, stop + 1));
  }
  return shortest;
}

TEST(Viewpoints, TheWayThroughOnePlaceOfEachStopIsTheShortest) {
  RandomStream random(7, "places", 0);
  const Vector3d from(0.0, 0.0, 0.0);
  for (std::size_t stops = 0; stops < 6; ++stops) {
    std::vector<std::vector<Vector3d>> options(stops);
    for (auto& places : options) {
      for (int i = 0; i < 4; ++i)
        places.emplace_back(random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 10));
    }
    const auto choice = shortest_through(from, options);
    ASSERT_EQ(choice.size(), stops);
    double length = 0.0;
    Vector3d at = from;
    for (std::size_t i = 0; i < stops; ++i) {
      length += (options[i].at(choice[i]) - at).norm();
      at = options[i][choice[i]];
    }
    EXPECT_NEAR(length, shortest_by_force(from, options, 0), 1e-9);
  }
}

}  // namespace
}  // namespace skein::agent
