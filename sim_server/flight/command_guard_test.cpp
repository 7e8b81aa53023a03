#include "sim_server/flight/command_guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/random_stream.hpp"
#include "sim_server/flight/position_control.hpp"

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

TEST_F(CommandGuardTest, TheGuardRefusesCommandsBeyondTheLimits) {
  const CommandGuard guard(vehicle_, rules_);
  EXPECT_FALSE(guard.refuse({.p_WB = {1e6, 0, 0}}, {}));
  EXPECT_FALSE(guard.refuse({.v_WB = {6, 0, 0}, .a_WB = {0, 0, 4}}, {}));
  EXPECT_FALSE(guard.refuse({.v_WB = {3.6, 4.8, 0}}, {}));
  const auto speed = guard.refuse({.v_WB = {4, 4, 3}}, {});
  ASSERT_TRUE(speed);
  EXPECT_EQ(*speed, "a velocity of 6.403 m/s is beyond the vehicle's limit of 6 m/s");
  EXPECT_TRUE(guard.refuse({.v_WB = {1, 0, 0}, .a_WB = {0, -5, 0}}, {}));
}

TEST_F(CommandGuardTest, TheGuardRefusesAYawRateBeyondTheLimitButNoYaw) {
  vehicle_.max_yaw_rate_deg_s = 60.0;
  const CommandGuard guard(vehicle_, rules_);
  const double limit = 60.0 * M_PI / 180.0;
  EXPECT_FALSE(guard.refuse({.p_WB = {1, 0, 5}, .yaw_rate = limit}, {}));
  EXPECT_FALSE(guard.refuse({.p_WB = {1, 0, 5}, .yaw_rate = -limit}, {}));
  EXPECT_FALSE(guard.refuse({.p_WB = {1, 0, 5}, .yaw = 3.0}, {}));
  EXPECT_TRUE(guard.refuse({.p_WB = {1, 0, 5}, .yaw_rate = -1.05}, {}));
  const auto reason = guard.refuse({.p_WB = {1, 0, 5}, .yaw_rate = 2.0 * limit}, {});
  ASSERT_TRUE(reason);
  EXPECT_EQ(*reason, "a yaw rate of 120 deg/s is beyond the vehicle's limit of 60 deg/s");
}

TEST_F(CommandGuardTest, TheTwoSwitchesAreIndependent) {
  rules_.reject_commands_beyond_limits = false;
  EXPECT_FALSE(CommandGuard(vehicle_, rules_).refuse({.v_WB = {60, 0, 0}, .yaw_rate = 50.0}, {}));
  CommandGuard leads(vehicle_, rules_);
  leads.lead({.p_WB = {100, 0, 5}}, {.p_WB = {0, 0, 5}});
  EXPECT_TRUE(leads.leading());
  rules_ = {};
  rules_.guard_position_commands = false;
  EXPECT_TRUE(CommandGuard(vehicle_, rules_).refuse({.v_WB = {60, 0, 0}}, {}));
}

TEST_F(CommandGuardTest, TheGuardRefusesBareAccelerationAtTheSpeedLimitButNotBraking) {
  const CommandGuard guard(vehicle_, rules_);
  const RigidBodyState fast{.v_WB = {5.95, 0, 0}};
  EXPECT_TRUE(guard.refuse({.a_WB = {3, 0, 0}}, fast));
  EXPECT_FALSE(guard.refuse({.a_WB = {-3, 0, 0}}, fast));
  EXPECT_FALSE(guard.refuse({.v_WB = {5.9, 0, 0}, .a_WB = {3, 0, 0}}, fast)) << "the velocity bounds the speed";
}

TEST_F(CommandGuardTest, TheGuardNeverAcceptsNumbersThatAreNotFinite) {
  rules_.reject_commands_beyond_limits = false;
  const CommandGuard guard(vehicle_, rules_);
  EXPECT_FALSE(guard.refuse({.v_WB = {100, 0, 0}}, {}));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(guard.refuse({.p_WB = {nan, 0, 0}}, {}));
  EXPECT_TRUE(guard.refuse({.v_WB = {0, inf, 0}}, {}));
  EXPECT_TRUE(guard.refuse({.a_WB = {0, 0, -inf}}, {}));
  EXPECT_TRUE(guard.refuse({.yaw = nan}, {}));
  EXPECT_TRUE(guard.refuse({.yaw_rate = inf}, {}));
}

/// A distance whose square overflows would make the carrot's position NaN. The law would take that for no position.
TEST_F(CommandGuardTest, TheFarthestPositionIsLedToWithinTheLimitsAndNoneBeyondIsAccepted) {
  rules_.reject_commands_beyond_limits = false;
  CommandGuard guard(vehicle_, rules_);
  RigidBodyState state{.p_WB = {1, 2, 5}, .v_WB = {0.5, 0, 0}};
  for (const double far : {1e6, 1e100, 1e153}) {
    const TrajectoryCommand command{.p_WB = {far, -far, far}};
    ASSERT_FALSE(guard.refuse(command, state)) << far;
    for (int step = 0; step < 100; ++step) {
      const TrajectoryCommand led = guard.lead(command, state);
      ASSERT_TRUE(led.p_WB.allFinite()) << far << ", step " << step;
      ASSERT_LT((led.p_WB - state.p_WB).norm(), 20.0) << far << ", step " << step;
      state.p_WB += 0.1 * (led.p_WB - state.p_WB);
    }
    guard.reset();
  }
  for (const double far : {1e155, -1e200, 1e308}) {
    EXPECT_TRUE(guard.refuse({.p_WB = {0, far, 0}}, state)) << far;
    EXPECT_TRUE(guard.refuse({.v_WB = {0, far, 0}}, state)) << far;
    EXPECT_TRUE(guard.refuse({.a_WB = {0, far, 0}}, state)) << far;
  }
}

TEST_F(CommandGuardTest, TheGuardPassesNearPositionsUnchanged) {
  CommandGuard guard(vehicle_, rules_);
  const TrajectoryCommand near{.p_WB = {10.9, 0, 5}, .v_WB = {1, 0, 0}};
  EXPECT_EQ(guard.lead(near, {.p_WB = {10, 0, 5}}).p_WB, near.p_WB);
  EXPECT_FALSE(guard.leading());
  const TrajectoryCommand velocity{.v_WB = {5, 0, 0}};
  EXPECT_EQ(guard.lead(velocity, {.p_WB = {10, 0, 5}}).v_WB, velocity.v_WB);
}

/// A point mass that obeys the law at once, with the guard before it.
class PointMass {
 public:
  PointMass(const VehicleConfig& vehicle, const RulesConfig& rules, const RigidBodyState& state)
      : guard_(vehicle, rules), law_(vehicle.position_control), state_(state) {}
  /// One control step. @returns the acceleration demanded, without gravity and integral.
  Vector3d step(const TrajectoryCommand& command) {
    const TrajectoryCommand led = guard_.lead(command, state_);
    p_W_led_ = led.p_WB;
    PositionController::Memory moving;
    moving.mode = ControlMode::moving;
    law_.set_memory(moving);
    law_.step(state_, led, 0);
    const auto& memory = law_.memory();
    const Vector3d integral = Vector3d(0.03, 0.03, 0.07).cwiseProduct(memory.position_error_sum);
    const Vector3d a = law_.target_acceleration() - integral - 9.781 * Vector3d::UnitZ();
    for (int i = 0; i < 20; ++i) {
      state_.v_WB += a * kTickS;
      state_.p_WB += state_.v_WB * kTickS;
    }
    return a;
  }
  const RigidBodyState& state() const { return state_; }
  bool led() const { return guard_.leading(); }
  /// The position that the law was given.
  const Vector3d& p_W_led() const { return p_W_led_; }

 private:
  CommandGuard guard_;
  PositionController law_;
  RigidBodyState state_;
  Vector3d p_W_led_ = Vector3d::Zero();
};

TEST_F(CommandGuardTest, BarePositionsAreApproachedWithinTheLimits) {
  RandomStream random(3, "guard", 0);
  const auto vector = [&](double size) {
    return Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
  };
  double fastest = 0.0;
  for (int run = 0; run < 60; ++run) {
    PointMass mass(vehicle_, rules_, {.p_WB = {200, 0, 200}, .v_WB = vector(3.4)});
    for (int target = 0; target < 4; ++target) {
      // The target may change on the way, also to a place right behind the UAV.
      const TrajectoryCommand command{.p_WB = mass.state().p_WB + vector(target % 2 == 0 ? 60.0 : 2.0)};
      const int steps = target == 3 ? 800 : 70;
      for (int i = 0; i < steps; ++i) {
        const Vector3d a = mass.step(command);
        ASSERT_LE(a.norm(), 4.0 * 1.01) << "run " << run << ", target " << target << ", step " << i;
        ASSERT_LE(mass.state().v_WB.norm(), 6.0 * 1.05);
        fastest = std::max(fastest, mass.state().v_WB.norm());
      }
      if (target == 3) {
        EXPECT_LT((mass.state().p_WB - command.p_WB).norm(), 0.02);
        EXPECT_FALSE(mass.led());
      }
    }
  }
  EXPECT_GT(fastest, 5.8);
}

TEST_F(CommandGuardTest, ThePointAheadReachesTheTargetWithinItsLimits) {
  constexpr double kStepS = 0.05, kSpeedUp = 4.0 * kStepS, kBraking = 0.8 * kSpeedUp;
  for (std::uint64_t i = 0; i < 60; ++i) {
    RandomStream random(i, "guard_point", 0);
    const Vector3d start(200, 0, 200);
    const Vector3d way =
        random.uniform(3.0, 60.0) * (i % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(static_cast<int>(i % 3));
    PointMass mass(vehicle_, rules_, {.p_WB = start});
    double speed = 0.0, gone = 0.0, fastest = 0.0;
    for (int step = 0; step < 800 && gone < way.norm() - 0.02; ++step) {
      mass.step({.p_WB = start + way});
      const double now = (mass.p_W_led() - start).dot(way.normalized());
      const double next_speed = (now - gone) / kStepS;
      if (step > 1) {  // the point ahead starts at some distance from the UAV
        ASSERT_LE(next_speed, speed + kSpeedUp + 1e-9) << "case " << i << " step " << step;
        ASSERT_GE(next_speed, speed - kBraking - 1e-9) << "case " << i << " step " << step;
      }
      ASSERT_LE(now, way.norm() + 1e-9) << "case " << i << ": it passes the target";
      ASSERT_NEAR((mass.p_W_led() - start - now * way.normalized()).norm(), 0.0, 1e-9) << "it leaves the line";
      speed = next_speed;
      gone = now;
      fastest = std::max(fastest, step > 0 ? speed : 0.0);
    }
    EXPECT_GE(gone, way.norm() - 0.02) << "case " << i;
    EXPECT_LE(fastest, 6.0 + 1e-9);
  }
}

TEST_F(CommandGuardTest, ThePointAheadMayBecomeTheTarget) {
  PointMass mass(vehicle_, rules_, {.p_WB = {200, 0, 200}, .v_WB = {5, 0, 0}});
  for (int step = 0; step < 20; ++step) mass.step({.p_WB = {260, 0, 200}});
  const Vector3d target = mass.p_W_led();
  mass.step({.p_WB = {260, 0, 200}});
  double before = (mass.p_W_led() - target).x() / 0.05;
  Vector3d last = mass.p_W_led();
  for (int step = 0; step < 400; ++step) {
    mass.step({.p_WB = step == 0 ? last : target});
    const double speed = (mass.p_W_led() - last).x() / 0.05;
    ASSERT_LE(std::abs(speed - before), 4.0 * 0.05 + 1e-9) << "step " << step;  // also fails for NaN
    before = speed;
    last = mass.p_W_led();
  }
  EXPECT_NEAR((mass.state().p_WB - target).norm(), 0.0, 0.02);
}

TEST_F(CommandGuardTest, AUavStopsWithinALittleMoreThanItsBrakingDistance) {
  PointMass mass(vehicle_, rules_, {.p_WB = {200, 0, 200}, .v_WB = {6, 0, 0}});
  double farthest = 0.0;
  for (int i = 0; i < 400; ++i) {
    mass.step({.p_WB = {200, 0, 200}});
    farthest = std::max(farthest, mass.state().p_WB.x() - 200.0);
  }
  EXPECT_GT(farthest, 0.98 * 6.0 * 6.0 / 8.0) << "it brakes with no more than the permitted acceleration";
  EXPECT_LT(farthest, 5.5);
  EXPECT_NEAR(mass.state().p_WB.x(), 200.0, 0.02);
}

TEST_F(CommandGuardTest, AGuardThatIsSwitchedOffPassesEveryCommandUnchanged) {
  rules_.guard_position_commands = false;
  CommandGuard guard(vehicle_, rules_);
  const TrajectoryCommand far{.p_WB = {1e4, 0, 50}, .v_WB = {1, 2, 3}, .a_WB = {4, 5, 6}, .yaw = 7, .yaw_rate = 8};
  const TrajectoryCommand led = guard.lead(far, {});
  EXPECT_EQ(led.p_WB, far.p_WB);
  EXPECT_EQ(led.v_WB, far.v_WB);
  EXPECT_EQ(led.a_WB, far.a_WB);
  EXPECT_EQ(led.yaw, far.yaw);
  EXPECT_FALSE(guard.leading());
  EXPECT_EQ(guard.limit_yaw_rate(100.0), 100.0);
}

TEST_F(CommandGuardTest, TheGuardLimitsTheYawRateThatTheLawDemands) {
  vehicle_.max_yaw_rate_deg_s = 30.0;
  const CommandGuard guard(vehicle_, rules_);
  EXPECT_DOUBLE_EQ(guard.limit_yaw_rate(1.5), 30.0 * M_PI / 180.0);
  EXPECT_DOUBLE_EQ(guard.limit_yaw_rate(-1.5), -30.0 * M_PI / 180.0);
  EXPECT_EQ(guard.limit_yaw_rate(0.2), 0.2);
}

TEST_F(CommandGuardTest, AMovingPositionAheadAtFullSpeedIsHeldBack) {
  // A velocity at the limit together with a position ahead of the UAV would demand a speed above the limit.
  CommandGuard guard(vehicle_, rules_);
  const TrajectoryCommand led =
      guard.lead({.p_WB = {10.9, 0, 5}, .v_WB = {6, 0, 0}}, {.p_WB = {10, 0, 5}, .v_WB = {6, 0, 0}});
  EXPECT_TRUE(guard.leading());
  EXPECT_NEAR(led.p_WB.x(), 10.0, 1e-9);
}

}  // namespace
}  // namespace skein::sim
