#include "uav_agent/planning/strips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

OrientedBox random_box(RandomStream& random) {
  OrientedBox box;
  box.center = {random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(30, 60)};
  box.size = {random.uniform(3, 90), random.uniform(3, 30), random.uniform(3, 55)};
  box.R_WO = Eigen::AngleAxisd(random.uniform(-3, 3), Vector3d::UnitZ()).toRotationMatrix();
  return box;
}

/// Whether a camera that looks at the strip from the sharp distance sees p, a point on the same face.
bool seen_from(const Strip& strip, const Vector3d& p, const CameraReach& reach) {
  const Vector3d along = (strip.end_W - strip.begin_W).normalized();
  const Vector3d to = p - strip.begin_W;
  if (std::abs(to.dot(strip.out_W)) > 0.1) return false;
  const double depth = 0.92 * reach.sharp_distance_m;
  const bool upright = std::abs(along.z()) > 0.5 || strip.kind != FaceKind::side;
  const double half_across = depth * (upright ? reach.half_width_slope : reach.half_height_slope);
  const double half_along = depth * (upright ? reach.half_height_slope : reach.half_width_slope);
  const double s = to.dot(along);
  return std::abs(to.dot(strip.across_W)) <= half_across && s >= -half_along && s <= strip.length() + half_along;
}

TEST(CameraReach, IsTheBenchmarksSharpDistance) {
  const CameraReach reach = camera_reach(CameraConfig(), 2.0);
  EXPECT_NEAR(reach.sharp_distance_m, 7.356, 0.001);
  EXPECT_NEAR(reach.blur_speed_mps, 2.0, 1e-9);
}

TEST(Strips, CoverEveryFaceOfAnyBox) {
  const CameraReach reach = camera_reach(CameraConfig(), 2.0);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed, "boxes", 0);
    const OrientedBox box = random_box(random);
    const auto strips = cut_into_strips({box}, reach, {});
    ASSERT_FALSE(strips.empty());
    for (int i = 0; i < 300; ++i) {
      Vector3d p_O(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
      const auto axis = static_cast<Eigen::Index>(random.bits() % 3);
      p_O[axis] = p_O[axis] < 0.0 ? -0.5 : 0.5;
      const Vector3d p = box.center + box.R_WO * p_O.cwiseProduct(box.size);
      const bool covered =
          std::any_of(strips.begin(), strips.end(), [&](const Strip& s) { return seen_from(s, p, reach); });
      const bool bottom = axis == 2 && p_O[2] < 0.0;
      EXPECT_TRUE(covered || bottom) << "seed " << seed << " point " << p.transpose();
    }
  }
}

TEST(Strips, AreNoLongerThanAsked) {
  RandomStream random(11, "boxes", 0);
  const auto strips =
      cut_into_strips({random_box(random), random_box(random)}, camera_reach({}, 2.0), {.max_length_m = 20.0});
  ASSERT_FALSE(strips.empty());
  for (const Strip& strip : strips) EXPECT_LE(strip.length(), 20.0 + 1e-9);
}

class SharedStrips : public testing::TestWithParam<std::size_t> {};

TEST_P(SharedStrips, EveryStripIsGivenExactlyOnceAndNoUavHasMuchMore) {
  const std::size_t uavs = GetParam();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, "share", 0);
    std::vector<OrientedBox> boxes;
    for (int i = 0; i < 4; ++i) boxes.push_back(random_box(random));
    const auto strips = cut_into_strips(boxes, camera_reach({}, 2.0), {});
    std::vector<double> work;
    for (const Strip& strip : strips) work.push_back(strip.length() / 1.84);
    std::vector<Vector3d> starts;
    for (std::size_t i = 0; i < uavs; ++i) starts.emplace_back(random.uniform(-60, 60), random.uniform(-60, 60), 0.0);
    const auto tours = share_strips(strips, work, starts, 4.5);
    ASSERT_EQ(tours.size(), uavs);
    std::set<std::size_t> seen;
    std::vector<double> load;
    for (const auto& tour : tours) {
      load.push_back(0.0);
      for (const Visit& visit : tour) {
        EXPECT_TRUE(seen.insert(visit.strip).second);
        load.back() += work[visit.strip];
      }
    }
    EXPECT_EQ(seen.size(), strips.size());
    const auto [least, most] = std::minmax_element(load.begin(), load.end());
    EXPECT_LT(*most - *least, 80.0);
    const auto again = share_strips(strips, work, starts, 4.5);
    for (std::size_t i = 0; i < uavs; ++i) {
      ASSERT_EQ(tours[i].size(), again[i].size());
      for (std::size_t j = 0; j < tours[i].size(); ++j) EXPECT_EQ(tours[i][j].strip, again[i][j].strip);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fleets, SharedStrips, testing::Values(1U, 2U, 5U, 8U, 20U));

TEST(SharedStrips, WithoutStripsAllToursAreEmpty) {
  const auto tours = share_strips({}, {}, {Vector3d::Zero(), Vector3d::UnitX()}, 4.0);
  ASSERT_EQ(tours.size(), 2U);
  EXPECT_TRUE(tours[0].empty() && tours[1].empty());
}

}  // namespace
}  // namespace skein::agent
