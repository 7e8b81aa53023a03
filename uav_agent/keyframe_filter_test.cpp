#include "uav_agent/keyframe_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(KeyframeFilter, ThinsOutButLeavesNoHole) {
  const auto wall = wall_at(3.0F);
  const auto kept = KeyframeFilter()(wall, {});
  EXPECT_LT(kept.size(), wall.size() / 3);
  for (const auto& p : wall) EXPECT_LT(nearest(kept, p.cast<double>()), 0.45);
}

TEST(KeyframeFilter, TakesBodiesOutAndNothingElse) {
  auto cloud = wall_at(3.0F);
  const KnownBody body{{2.0, 5.0, 6.5}, 0.9};
  for (float a = 0.0F; a < 6.2F; a += 0.3F)
    cloud.emplace_back(2.0F + 0.6F * std::cos(a), 5.0F + 0.6F * std::sin(a), 6.5F);
  const auto kept = KeyframeFilter()(cloud, {body});
  for (const auto& p : kept) EXPECT_GT((p.cast<double>() - body.p_W).norm(), 0.9);
  EXPECT_LT(nearest(kept, {3.0, 5.0, 6.5}), 0.3) << "the wall behind the body stays";
}

TEST(KeyframeFilter, DropsALonePointButKeepsAThinMember) {
  auto cloud = wall_at(3.0F);
  cloud.emplace_back(20.0F, 20.0F, 20.0F);
  for (float z = 5.0F; z < 9.0F; z += 0.9F) cloud.emplace_back(-10.0F, 0.0F, z);
  const auto kept = KeyframeFilter()(cloud, {});
  EXPECT_GT(nearest(kept, {20.0, 20.0, 20.0}), 5.0);
  EXPECT_LT(nearest(kept, {-10.0, 0.0, 6.8}), 0.5);
}

TEST(KeyframeFilter, SurvivesNothingAndNonsense) {
  EXPECT_TRUE(KeyframeFilter()({}, {}).empty());
  const float nan = std::nanf("");
  const auto kept = KeyframeFilter()({{nan, 0.0F, 1.0F}, {1.0F, 1.0F, -40.0F}, {1.0F, 1.0F, 1.0F}}, {});
  EXPECT_EQ(kept.size(), 1U);
}

}  // namespace
}  // namespace skein::agent
