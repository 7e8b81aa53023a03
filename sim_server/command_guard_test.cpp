#include "sim_server/command_guard.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace skein::sim {
namespace {

class CommandGuardTest : public testing::Test {
 protected:
  CommandGuardTest() {
    vehicle_.max_speed_mps = 6.0;
    vehicle_.max_acceleration_mps2 = 4.0;
  }
  VehicleConfig vehicle_;
  RulesConfig rules_;
};

TEST_F(CommandGuardTest, RefusesWhatIsBeyondTheLimits) {
  const CommandGuard guard(vehicle_, rules_);
  EXPECT_FALSE(guard.refuse({.p_WB = {1e6, 0, 0}}, {}));
  EXPECT_FALSE(guard.refuse({.v_WB = {6, 0, 0}, .a_WB = {0, 0, 4}}, {}));
  EXPECT_FALSE(guard.refuse({.v_WB = {3.6, 4.8, 0}}, {}));
  const auto speed = guard.refuse({.v_WB = {4, 4, 3}}, {});
  ASSERT_TRUE(speed);
  EXPECT_EQ(*speed, "a velocity of 6.403 m/s is beyond the vehicle's limit of 6 m/s");
  EXPECT_TRUE(guard.refuse({.v_WB = {1, 0, 0}, .a_WB = {0, -5, 0}}, {}));
}

TEST_F(CommandGuardTest, RefusesBareAccelerationAtTheSpeedLimitButNotBraking) {
  const CommandGuard guard(vehicle_, rules_);
  const RigidBodyState fast{.v_WB = {5.95, 0, 0}};
  EXPECT_TRUE(guard.refuse({.a_WB = {3, 0, 0}}, fast));
  EXPECT_FALSE(guard.refuse({.a_WB = {-3, 0, 0}}, fast));
  EXPECT_FALSE(guard.refuse({.v_WB = {5.9, 0, 0}, .a_WB = {3, 0, 0}}, fast)) << "the velocity bounds the speed";
}

TEST_F(CommandGuardTest, NeverAcceptsWhatIsNotANumber) {
  rules_.enforce_command_limits = false;
  const CommandGuard guard(vehicle_, rules_);
  EXPECT_FALSE(guard.refuse({.v_WB = {100, 0, 0}}, {}));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(guard.refuse({.p_WB = {nan, 0, 0}}, {}));
  EXPECT_TRUE(guard.refuse({.v_WB = {0, inf, 0}}, {}));
  EXPECT_TRUE(guard.refuse({.a_WB = {0, 0, -inf}}, {}));
  EXPECT_TRUE(guard.refuse({.yaw = nan}, {}));
}

TEST_F(CommandGuardTest, PassesNearPositionsUntouched) {
  CommandGuard guard(vehicle_, rules_);
  const TrajectoryCommand near{.p_WB = {10.9, 0, 5}, .v_WB = {1, 0, 0}};
  EXPECT_EQ(guard.lead(near, {.p_WB = {10, 0, 5}}).p_WB, near.p_WB);
  EXPECT_FALSE(guard.leading());
  const TrajectoryCommand velocity{.v_WB = {5, 0, 0}};
  EXPECT_EQ(guard.lead(velocity, {.p_WB = {10, 0, 5}}).v_WB, velocity.v_WB);
}

TEST_F(CommandGuardTest, LeadsAPointWithinTheLimitsToAFarPosition) {
  CommandGuard guard(vehicle_, rules_);
  const Vector3d target(60, 20, 30);
  const RigidBodyState state{.p_WB = {10, 0, 5}};  // as if it never moved
  Vector3d p = state.p_WB, v = Vector3d::Zero();
  double fastest = 0.0;
  for (int i = 0; i < 400; ++i) {
    const Vector3d next = guard.lead({.p_WB = target}, state).p_WB;
    const Vector3d next_v = (next - p) / 0.05;
    EXPECT_LE(next_v.norm(), 6.0 + 1e-9);
    if ((next - target).norm() > 0.05) {
      EXPECT_LE((next_v - v).norm() / 0.05, 4.0 + 1e-6) << i;
    }
    fastest = std::max(fastest, next_v.norm());
    p = next;
    v = next_v;
  }
  EXPECT_NEAR(fastest, 6.0, 1e-6);
  EXPECT_EQ(p, target);
}

TEST_F(CommandGuardTest, AMovingPositionAheadAtFullSpeedIsHeldBack) {
  // Velocity at the limit and the position always ahead would add up to more.
  CommandGuard guard(vehicle_, rules_);
  const TrajectoryCommand led =
      guard.lead({.p_WB = {10.9, 0, 5}, .v_WB = {6, 0, 0}}, {.p_WB = {10, 0, 5}, .v_WB = {6, 0, 0}});
  EXPECT_TRUE(guard.leading());
  EXPECT_NEAR(led.p_WB.x(), 10.0, 1e-9);
}

}  // namespace
}  // namespace skein::sim
