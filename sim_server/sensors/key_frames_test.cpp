// Tests which scans become key frames, and how their clouds are thinned out.
#include "sim_server/sensors/key_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/math/euler.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

struct Offer {
  double t_s, x, yaw_deg;
  bool kept;
};

/// Offers scans at poses along x, one after the other.
void expect_kept(const char* what, const std::vector<Offer>& offers) {
  SCOPED_TRACE(what);
  KeyFrameSelector selector;
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < offers.size(); ++i) {
    const auto& [t_s, x, yaw_deg, kept] = offers[i];
    LidarScan scan;
    scan.tick = ticks(t_s);
    scan.points_W = {{1.0F, 2.0F, 3.0F}};
    // A tilted body: only its yaw may matter.
    const Isometry3d X_WB =
        Eigen::Translation3d(x, 5.0, 7.0) * Eigen::Quaterniond(test::rotation(0.2, -0.1, yaw_deg * kRadPerDeg));
    const auto keyframe = selector.offer(scan, X_WB);
    ASSERT_EQ(keyframe.has_value(), kept) << "offer " << i;
    if (keyframe) {
      EXPECT_EQ(keyframe->number, number++);
      EXPECT_EQ(keyframe->tick, scan.tick);
      EXPECT_TRUE(keyframe->X_WB.isApprox(X_WB));
      EXPECT_EQ(keyframe->points_W, scan.points_W);
    }
  }
}

TEST(Keyframes, TheFirstScanIsAlwaysAKeyFrame) { expect_kept("first", {{0.0, 0.0, 0.0, true}}); }

TEST(Keyframes, AScanMoreThanASecondLaterAndAwayFromOthersIsAKeyFrame) {
  expect_kept("more than a second", {{0.0, 0.0, 0.0, true},
                                     {0.5, 9.0, 0.0, false},
                                     {1.0, 9.0, 0.0, false},  // exactly one second is not more
                                     {1.1, 9.0, 0.0, true},
                                     {2.1, 20.0, 0.0, false},
                                     {2.2, 20.0, 0.0, true}});
}

TEST(Keyframes, AScanMoreThanTwoMetresFromAllOthersIsAKeyFrame) {
  expect_kept("more than two metres from the nearest", {{0.0, 0.0, 0.0, true},
                                                        {2.0, 1.9, 0.0, false},
                                                        {4.0, 2.0, 0.0, false},  // exactly two metres is not more
                                                        {6.0, 2.1, 0.0, true},
                                                        {8.0, 0.5, 0.0, false},  // near the first one again
                                                        {10.0, 4.0, 0.0, false},
                                                        {12.0, 4.2, 0.0, true}});
}

TEST(Keyframes, AScanTurnedFromAllItsNeighboursIsAKeyFrame) {
  expect_kept("ten degrees from all, across the turn too",
              {{0.0, 0.0, 175.0, true},
               {2.0, 0.0, -176.0, false},  // nine degrees
               {4.0, 0.0, -174.0, true},
               {6.0, 0.5, -170.0, false},
               {8.0, 0.5, 176.0, false},  // far from one, close to the other
               {10.0, 0.5, -160.0, true}});
}

TEST(Keyframes, OnlyTheFiveNearestCountForYaw) {
  expect_kept("the sixth does not", {{0.0, 0.0, 0.0, true},  // this yaw is offered again, among nearer neighbours
                                     {2.0, 2.5, 20.0, true},
                                     {4.0, 2.5, 40.0, true},
                                     {6.0, 2.5, 60.0, true},
                                     {8.0, 2.5, 80.0, true},
                                     {10.0, 2.0, 0.0, false},  // the first is still the fifth nearest
                                     {12.0, 2.5, 100.0, true},
                                     {14.0, 2.0, 0.0, true}});
}

TEST(UniformSampling, ThePointNearestToEachCellsCentreStays) {
  RandomStream random(1, "keyframes_test", 0, 0);
  std::vector<Eigen::Vector3f> cloud;
  for (int i = 0; i < 4000; ++i) {
    cloud.push_back(test::random_in_box(random, {-3.0, -2.0, -1.0}, {4.0, 2.0, 3.0}).cast<float>());
  }
  using Cell = std::tuple<int, int, int>;
  std::map<Cell, std::pair<double, std::size_t>> best;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3d p = cloud[i].cast<double>();
    const Vector3d cell = (p / 0.5).array().floor();
    const double distance = (p - 0.5 * (cell + Vector3d::Constant(0.5))).norm();
    const Cell key(static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()));
    const auto [found, added] = best.try_emplace(key, distance, i);
    if (!added && distance < found->second.first) {
      found->second = {distance, i};
    }
  }
  std::vector<std::size_t> kept;
  for (const auto& entry : best) {
    kept.push_back(entry.second.second);
  }
  std::ranges::sort(kept);
  std::vector<Eigen::Vector3f> expected;
  for (const std::size_t i : kept) {
    expected.push_back(cloud[i]);
  }
  EXPECT_EQ(sample_uniformly(cloud, 0.5), expected);
}

TEST(UniformSampling, CellsThatAreFarApartAreNotMixedUp) {
  RandomStream random(2, "keyframes_test", 0, 0);
  std::vector<Eigen::Vector3f> cloud;  // pairs in one cell each
  for (int i = 0; i < 600; ++i) {
    const Vector3d p = test::random_in_box(random, {-1000.0, -1000.0, -200.0}, {1000.0, 1000.0, 400.0});
    const Vector3d centre = 0.5 * ((p / 0.5).array().floor() + 0.5).matrix();
    cloud.push_back(centre.cast<float>());
    cloud.push_back((centre + Vector3d(0.125, 0.0, 0.0)).cast<float>());
  }
  std::vector<Eigen::Vector3f> expected;
  for (std::size_t i = 0; i < cloud.size(); i += 2) expected.push_back(cloud[i]);
  EXPECT_EQ(sample_uniformly(cloud, 0.5), expected);
}

TEST(UniformSampling, OfTwoPointsAtTheSameDistanceTheEarlierStays) {
  const std::vector<Eigen::Vector3f> cloud = {{0.25F, 0.25F, 0.125F}, {0.25F, 0.25F, 0.375F}, {0.75F, 0.25F, 0.25F}};
  EXPECT_EQ(sample_uniformly(cloud, 0.5), (std::vector<Eigen::Vector3f>{cloud[0], cloud[2]}));
  EXPECT_TRUE(sample_uniformly({}, 0.5).empty());
}

}  // namespace
}  // namespace skein::sim
