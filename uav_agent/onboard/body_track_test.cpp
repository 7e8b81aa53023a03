#include "uav_agent/onboard/body_track.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::agent {
namespace {

/// A body that accelerates and turns about a fixed axis, by nearly as much as the bounds allow.
RigidBodyState lively(Tick tick) {
  const double t = seconds(tick);
  const Vector3d axis_W = Vector3d(1.0, -2.0, 2.0) / 3.0;
  RigidBodyState state;
  state.p_WB = Vector3d(100.0 + std::sin(4.0 * t), -50.0 + 3.0 * t, 8.0 + 0.5 * std::cos(5.0 * t));
  state.v_WB = Vector3d(4.0 * std::cos(4.0 * t), 3.0, -2.5 * std::sin(5.0 * t));
  state.q_WB = Eigen::AngleAxisd(3.0 + 0.6 * std::sin(8.0 * t), axis_W);
  state.w_WB_B = 4.8 * std::cos(8.0 * t) * axis_W;
  return state;
}

TEST(BodyTrack, MeetsTheOdometryAndStaysWithinItsBoundsBetween) {
  BodyTrack track(80, 40);
  double farthest = 0.0, most_turned = 0.0;
  for (Tick tick = 0; tick <= 400; tick += 20) {
    track.add(tick, lively(tick));
    for (Tick t = std::max<Tick>(0, tick - 80); t <= tick; ++t) {
      const auto pose = track.at(t);
      ASSERT_TRUE(pose) << t << " of " << tick;
      const Isometry3d X_WB = lively(t).X_WB();
      const double off = (pose->X_WB.translation() - X_WB.translation()).norm();
      const double turned = Eigen::AngleAxisd(pose->X_WB.linear().transpose() * X_WB.linear()).angle();
      if (t % 20 == 0) {
        ASSERT_TRUE(pose->X_WB.isApprox(X_WB, 1e-15));
        ASSERT_EQ(pose->error_m + pose->error_rad, 0.0);
      } else {
        ASSERT_LT(off, pose->error_m);
        ASSERT_LT(turned, pose->error_rad);
        ASSERT_LT(pose->error_m, 0.0032);
        ASSERT_LT(pose->error_rad, 0.0063);
      }
      farthest = std::max(farthest, off);
      most_turned = std::max(most_turned, turned);
    }
  }
  // A straight line between the odometries would be off by 5 mm and 12 mrad.
  EXPECT_LT(farthest, 1e-4);
  EXPECT_LT(most_turned, 1e-3);
  EXPECT_GT(most_turned, 1e-9) << "there is something to interpolate";
}

TEST(BodyTrack, HasNoPoseOutsideItsOdometryAndInGaps) {
  BodyTrack track(80, 20);
  EXPECT_FALSE(track.at(0));
  for (const Tick tick : {0, 20, 60, 80}) track.add(tick, lively(tick));
  EXPECT_FALSE(track.at(-1));
  EXPECT_FALSE(track.at(81));
  EXPECT_TRUE(track.at(7));
  EXPECT_FALSE(track.at(40)) << "in the gap";
  EXPECT_TRUE(track.at(60)) << "at its end";
  for (Tick tick = 100; tick <= 200; tick += 20) track.add(tick, lively(tick));
  EXPECT_FALSE(track.at(99)) << "forgotten";
  EXPECT_TRUE(track.at(121));
  track.add(40, lively(40));
  EXPECT_FALSE(track.at(130)) << "time began anew";
  EXPECT_TRUE(track.at(40));
}

}  // namespace
}  // namespace skein::agent
