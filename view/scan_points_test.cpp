#include "view/scan_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "process/json_text.hpp"
#include "view/testing/unpacked.hpp"

namespace skein::view {
namespace {

std::vector<Eigen::Vector3f> random_points(std::mt19937& random, std::size_t count, float reach) {
  std::uniform_real_distribution<float> along(-reach, reach);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(along(random), along(random), along(random));
  return points;
}

TEST(ScanPoints, KeepOnePointInEachCubeAboveTheGround) {
  std::mt19937 random(1);
  ScanPoints scan;
  const auto points = random_points(random, 4000, 4.0F);
  scan.add(points);
  scan.add(points);
  const auto kept = scan.take(100'000);
  EXPECT_TRUE(scan.empty());
  EXPECT_GT(kept.size(), 500U);
  EXPECT_LE(kept.size(), 16U * 16U * 8U);
  const auto cube = [](const Eigen::Vector3f& p) { return Eigen::Vector3f((2.0F * p).array().floor()); };
  for (const Eigen::Vector3f& p : kept) {
    EXPECT_GE(p.z(), 0.3F);
    EXPECT_EQ(std::ranges::count_if(kept, [&](const auto& other) { return cube(other) == cube(p); }), 1);
  }
  for (const Eigen::Vector3f& p : points) {
    if (p.z() < 0.3F) continue;
    EXPECT_TRUE(std::ranges::any_of(kept, [&](const auto& other) { return cube(other) == cube(p); }));
  }
}

TEST(ScanPoints, LeaveOutPointsThatCannotBeEncoded) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  std::mt19937 random(5);
  for (const float invalid : {kInfinite, -kInfinite, std::nanf(""), 1e30F, -1e30F, 3'277.0F, -3'277.0F}) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Eigen::Vector3f> points = random_points(random, 50, 1'000.0F);
      for (Eigen::Vector3f& p : points) {
        p.z() = std::abs(p.z()) + 1.0F;
        p[axis] = invalid;
      }
      ScanPoints scan(3);
      scan.add(points);
      EXPECT_TRUE(scan.empty()) << invalid << " on axis " << axis;
      scan.add(std::vector<Eigen::Vector3f>{{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}, {-3'276.0F, 0.0F, 3'276.0F}});
      EXPECT_EQ(scan.take(10).size(), 3U) << "the points left out do not count towards the limit";
    }
  }
}

TEST(ScanPoints, AreAtMostAsManyAsRequested) {
  std::mt19937 random(2);
  ScanPoints scan;
  for (int i = 0; i < 20; ++i) scan.add(random_points(random, 3000, 100.0F));
  const auto few = scan.take(50);
  EXPECT_EQ(few.size(), 50U);
  EXPECT_TRUE(scan.take(50).empty());
  for (int i = 0; i < 20; ++i) scan.add(random_points(random, 3000, 100.0F));
  EXPECT_EQ(scan.take(100'000).size(), ScanPoints::kMostKept);
  scan.add(few);
  EXPECT_EQ(scan.take(0).size(), 0U);
}

TEST(ScanPoints, TakeNewReturnsAtMostOnePointOfEachCubeEver) {
  std::mt19937 random(4);
  ScanPoints scan(300);
  const auto first = random_points(random, 100, 5.0F), second = random_points(random, 2000, 5.0F);
  scan.add(first);
  const std::size_t early = scan.take_new().size();
  EXPECT_GT(early, 20U);
  scan.add(first);
  EXPECT_TRUE(scan.empty());
  scan.add(second);
  EXPECT_EQ(early + scan.take_new().size(), 300U) << "at most most_kept points in all";
  scan.add(random_points(random, 100, 100.0F));
  EXPECT_TRUE(scan.empty());
}

TEST(ScanPoints, AreDecodedWithinADecimetreOfTheirPlace) {
  std::mt19937 random(3);
  auto points = random_points(random, 200, 3000.0F);
  const auto arrived = unpacked_points(packed_points(points));
  ASSERT_EQ(arrived.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((arrived[i] - points[i].cast<double>()).norm(), 0.09);
  points = {{1e9F, 0.0F, 1.0F}, {1.0F, 2.0F, 3.0F}, {0.0F, std::nanf(""), 0.0F}};
  EXPECT_EQ(unpacked_points(packed_points(points)).size(), 1U)
      << "points that are too far away, or not finite, are left out";
  const std::vector<Eigen::Vector3f> two = {{1.0F, -2.0F, 3.0F}, {-300.0F, 0.0F, 0.5F}};
  EXPECT_EQ(packed_points(two), "CgDs/x4ASPQAAAUA") << "the encoding that web/src/packed.js decodes";
  const Json sent = parse_json(lidar_text("a", std::vector<PointsStep>{{2.5, two}}));
  EXPECT_EQ(sent["n"], "lidar a");
  EXPECT_EQ(sent["steps"][0]["t"], 2.5);
  EXPECT_EQ(unpacked_points(sent["steps"][0]["points"].get<std::string>()).size(), 2U);
}

}  // namespace
}  // namespace skein::view
