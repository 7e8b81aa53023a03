#include "uav_agent/maps/repeated_scans.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr double kWidthM = 0.05;

Isometry3d pose(const Vector3d& p_W, double about_x, double about_z = 0.0) {
  return Eigen::Translation3d(p_W) * Eigen::AngleAxisd(about_z, Vector3d::UnitZ()) *
         Eigen::AngleAxisd(about_x, Vector3d::UnitX());
}

TEST(RepeatedScans, ScansOfAHoveringUavCountOnce) {
  RepeatedScans scans(kWidthM);
  RandomStream random(1, "hover", 0);
  for (int round = 0; round < 5; ++round) {
    for (int step = -10; step <= 10; ++step) {
      const Vector3d p_W(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05));
      const auto repeated = scans.ask(pose(p_W, 0.0785 * step + random.uniform(-0.005, 0.005)));
      EXPECT_EQ(repeated.all, round > 0) << round << " " << step;
    }
  }
}

TEST(RepeatedScans, ScansOfATurningUavAreNew) {
  RepeatedScans scans(kWidthM);
  for (int step = 0; step < 30; ++step) EXPECT_FALSE(scans.ask(pose(Vector3d::Zero(), 0.0, 0.05 * step)).all) << step;
  EXPECT_TRUE(scans.ask(pose(Vector3d::Zero(), 0.0, 0.5)).all);
}

/// While a UAV flies straight on, its beams ahead and behind repeat earlier ones, and the others do not.
TEST(RepeatedScans, BeamsAlongThePathRepeatEarlierOnes) {
  for (std::uint64_t world = 0; world < 50; ++world) {
    RandomStream random(world, "way", 0);
    const auto drawn = [&] { return Vector3d(random.normal(), random.normal(), random.normal()).normalized(); };
    RepeatedScans scans(kWidthM);
    const Vector3d p_W = 20.0 * drawn();
    EXPECT_FALSE(scans.ask(pose(p_W, 0.3)).all);
    const Vector3d way = random.uniform(0.3, 4.0) * drawn();
    const auto repeated = scans.ask(pose(p_W + way, 0.3));
    ASSERT_FALSE(repeated.all);
    for (int beam = 0; beam < 200; ++beam) {
      const Vector3d direction = beam % 2 == 0 ? drawn() : (way.normalized() + 0.2 * drawn()).normalized();
      const double apart_m = way.cross(direction).norm();  // between the two beams
      if (std::abs(apart_m - kWidthM) < 1e-4) continue;
      EXPECT_EQ(repeated(direction.cast<float>()), apart_m < kWidthM) << apart_m;
    }
  }
}

TEST(RepeatedScans, ARepeatedScanIsNotComparedWithLaterOnes) {
  RepeatedScans scans(kWidthM);
  EXPECT_FALSE(scans.ask(pose(Vector3d::Zero(), 0.0)).all);
  EXPECT_TRUE(scans.ask(pose({0.2, 0.0, 0.0}, 0.0)).all);
  EXPECT_FALSE(scans.ask(pose({0.4, 0.0, 0.0}, 0.0)).all) << "0.4 m from the one that counted";
}

}  // namespace
}  // namespace skein::agent
