#include "uav_agent/onboard/key_frame_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

std::vector<Eigen::Vector3f> wall_at(float x) {
  std::vector<Eigen::Vector3f> wall;
  for (float y = 0.0F; y < 10.0F; y += 0.1F) {
    for (float z = 5.0F; z < 8.0F; z += 0.1F) wall.emplace_back(x, y, z);
  }
  return wall;
}

double nearest(const std::vector<Eigen::Vector3f>& points, const Vector3d& p) {
  double best = 1e9;
  for (const auto& q : points) best = std::min(best, (q.cast<double>() - p).norm());
  return best;
}

TEST(KeyFrameFilter, ThinsOutButLeavesNoHole) {
  const auto wall = wall_at(3.0F);
  const auto kept = KeyFrameFilter()(wall, {});
  EXPECT_LT(kept.size(), wall.size() / 3);
  for (const auto& p : wall) EXPECT_LT(nearest(kept, p.cast<double>()), 0.45);
}

TEST(KeyFrameFilter, TakesBodiesOutAndNothingElse) {
  auto cloud = wall_at(3.0F);
  const KnownBody body{{2.0, 5.0, 6.5}, 0.9};
  for (float a = 0.0F; a < 6.2F; a += 0.3F)
    cloud.emplace_back(2.0F + 0.6F * std::cos(a), 5.0F + 0.6F * std::sin(a), 6.5F);
  const auto kept = KeyFrameFilter()(cloud, {body});
  for (const auto& p : kept) EXPECT_GT((p.cast<double>() - body.p_W).norm(), 0.9);
  EXPECT_LT(nearest(kept, {3.0, 5.0, 6.5}), 0.3) << "the wall behind the body stays";
}

TEST(KeyFrameFilter, DropsALonePointButKeepsAThinMember) {
  auto cloud = wall_at(3.0F);
  cloud.emplace_back(20.0F, 20.0F, 20.0F);
  for (float z = 5.0F; z < 9.0F; z += 0.9F) cloud.emplace_back(-10.0F, 0.0F, z);
  const auto kept = KeyFrameFilter()(cloud, {});
  EXPECT_GT(nearest(kept, {20.0, 20.0, 20.0}), 5.0);
  EXPECT_LT(nearest(kept, {-10.0, 0.0, 6.8}), 0.5);
}

TEST(KeyFrameFilter, KeepsOnlyPointsWithEnoughNeighbours) {
  std::size_t kept_in_all = 0, dropped_in_all = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed, "cloud", 0);
    std::vector<Eigen::Vector3f> cloud;
    for (int i = 0; i < 400; ++i) {
      const Vector3d p(random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0), random.uniform(0.0, 12.0));
      cloud.push_back(p.cast<float>());
    }
    KeyFrameFilter::Config config{.lone_radius_m = random.uniform(0.8, 2.0), .lone_min_neighbours = 0};
    const auto thinned = KeyFrameFilter(config)(cloud, {});
    config.lone_min_neighbours = 1 + static_cast<int>(seed % 4);
    const float radius = static_cast<float>(config.lone_radius_m);
    std::vector<Eigen::Vector3f> expected;
    for (const auto& p : thinned) {
      const auto near = [&](const auto& q) { return (q - p).squaredNorm() <= radius * radius; };
      const auto others = std::ranges::count_if(thinned, near) - 1;
      if (others >= config.lone_min_neighbours) expected.push_back(p);
    }
    EXPECT_EQ(KeyFrameFilter(config)(cloud, {}), expected) << "seed " << seed;
    kept_in_all += expected.size();
    dropped_in_all += thinned.size() - expected.size();
  }
  EXPECT_GT(std::min(kept_in_all, dropped_in_all), 500U) << "both must have been drawn often";
}

TEST(KeyFrameFilter, AcceptsAnEmptyCloudAndDropsImpossiblePoints) {
  EXPECT_TRUE(KeyFrameFilter()({}, {}).empty());
  const float nan = std::nanf("");
  const auto kept = KeyFrameFilter()({{nan, 0.0F, 1.0F}, {1.0F, 1.0F, -40.0F}, {1.0F, 1.0F, 1.0F}}, {});
  EXPECT_EQ(kept.size(), 1U);
}

}  // namespace
}  // namespace skein::agent
