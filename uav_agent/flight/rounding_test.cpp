// Rounded paths turn gently and stay near the corners. Corners without enough room are not rounded.
#include "uav_agent/flight/rounding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

const auto kFree = [](const Vector3d&, const Vector3d&) { return true; };

double sharpest_cosine(const Vector3d& from, const std::vector<Vector3d>& way) {
  double least = 1.0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Vector3d in = way[i] - (i > 0 ? way[i - 1] : from), out = way[i + 1] - way[i];
    least = std::min(least, in.normalized().dot(out.normalized()));
  }
  return least;
}

double distance_to_way(const Vector3d& p, const Vector3d& from, const std::vector<Vector3d>& way) {
  double nearest = (p - from).norm();
  Vector3d a = from;
  for (const Vector3d& b : way) {
    const double length = (b - a).norm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(b - a) / (length * length), 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (p - a - t * (b - a)).norm());
    a = b;
  }
  return nearest;
}

TEST(Rounding, RightAnglesBecomeGentleTurns) {
  const Vector3d from(0, 0, 5);
  const std::vector<Vector3d> zigzag = {{10, 0, 5}, {10, 10, 5}, {20, 10, 5}, {20, 10, 15}};
  const auto way = rounded(from, zigzag, 2.0, kFree);
  EXPECT_GT(sharpest_cosine(from, way), std::cos(0.6));
  EXPECT_EQ(way.back(), zigzag.back());
}

TEST(Rounding, StaysNearTheWayAndItsCorners) {
  const Vector3d from(0, 0, 5);
  const std::vector<Vector3d> corners = {{6, 0, 5}, {6, 9, 6}, {0, 9, 9}, {1, 3, 12}};
  const auto way = rounded(from, corners, 2.0, kFree);
  for (const Vector3d& p : way) EXPECT_LT(distance_to_way(p, from, corners), 2.0);
  for (const Vector3d& corner : corners) EXPECT_LT(distance_to_way(corner, from, way), 2.0);
}

TEST(Rounding, ACornerWithoutRoomStays) {
  const Vector3d from(0, 0, 5);
  const std::vector<Vector3d> corners = {{10, 0, 5}, {10, 10, 5}};
  EXPECT_EQ(rounded(from, corners, 2.0, [](const Vector3d&, const Vector3d&) { return false; }), corners);
}

TEST(Rounding, StraightPathsStayAsTheyAreAndRepeatedCornersStayFinite) {
  const std::vector<Vector3d> straight = {{5, 0, 5}, {10, 0, 5}};
  EXPECT_EQ(rounded({0, 0, 5}, straight, 2.0, kFree), straight);
  const std::vector<Vector3d> doubled = {{5, 0, 5}, {5, 0, 5}, {5, 5, 5}};
  for (const Vector3d& p : rounded({0, 0, 5}, doubled, 2.0, kFree)) EXPECT_TRUE(p.allFinite());
  EXPECT_TRUE(rounded({0, 0, 5}, {}, 2.0, kFree).empty());
}

}  // namespace
}  // namespace skein::agent
