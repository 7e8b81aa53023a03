#include "uav_agent/planning/aiming.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

TEST(Aiming, ThePointComesIntoTheMiddleOfTheImage) {
  const VehicleConfig vehicle;
  for (int i = 0; i < 100; ++i) {
    RigidBodyState state;
    state.p_WB = {1.0 * i, -0.5 * i, 10.0};
    const double body_yaw = 0.37 * i;
    state.q_WB = Quaterniond(rotation_z(body_yaw));
    // Directions that are within the gimbal's limits of yaw and pitch.
    const double yaw = -1.4 + 0.028 * i, pitch = 1.2 * std::sin(0.9 * i);
    const Vector3d axis = rotation_z(body_yaw + yaw) * rotation_y(pitch) * Vector3d::UnitX();
    const Vector3d p_W = state.X_WB() * vehicle.camera.p_BC + 7.0 * axis;
    const GimbalCommand command = aim_at(p_W, state, vehicle);
    EXPECT_NEAR(command.pitch, pitch, 1e-9);
    EXPECT_NEAR(command.yaw, yaw, 1e-9);
    GimbalState gimbal;
    gimbal.pitch = command.pitch;
    gimbal.yaw = command.yaw;
    EXPECT_LT(aim_error(p_W, state, gimbal, vehicle), 1e-6);
    gimbal.pitch += 0.2;
    EXPECT_NEAR(aim_error(p_W, state, gimbal, vehicle), 0.2, 1e-6);
  }
}

TEST(Aiming, TheCommandStaysWithinTheLimitsOfTheGimbal) {
  const VehicleConfig vehicle;
  const GimbalCommand down = aim_at({0.2, 0.0, -50.0}, RigidBodyState(), vehicle);
  EXPECT_NEAR(down.pitch, vehicle.gimbal.pitch_limit_deg * kRadPerDeg, 1e-9);
  const GimbalCommand behind = aim_at({-50.0, 1.0, 0.0}, RigidBodyState(), vehicle);
  EXPECT_NEAR(behind.yaw, vehicle.gimbal.yaw_limit_deg * kRadPerDeg, 1e-9);
}

TEST(Aiming, TheYawTurnsTheUavTowardsASteepFaceAndIsUndefinedForAFlatOne) {
  for (double heading = -3.0; heading < 3.1; heading += 0.25) {
    for (const double rise : {-0.9, -0.4, 0.0, 0.4, 0.9}) {
      const Vector3d out_W = Vector3d(std::cos(heading), std::sin(heading), rise).normalized();
      const auto yaw = yaw_facing(out_W);
      ASSERT_EQ(yaw.has_value(), std::abs(rise) < 0.5) << rise;
      if (!yaw) continue;
      const Vector3d ahead_W(std::cos(*yaw), std::sin(*yaw), 0.0);
      EXPECT_NEAR(ahead_W.dot(out_W), -out_W.head<2>().norm(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace skein::agent
