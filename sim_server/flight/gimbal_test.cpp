// The gimbal law in cases that the reference vectors lack: reported rates, stops, modes.
#include "sim_server/flight/gimbal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

GimbalCommand angle(double pitch, double yaw) { return {GimbalMode::angle, pitch, yaw}; }
GimbalCommand rate(double pitch, double yaw) { return {GimbalMode::rate, pitch, yaw}; }

TEST(Gimbal, WithoutPhantomRateTheReportedRateIsThatOfTheMotion) {
  Gimbal gimbal({});
  for (int i = 0; i < 400; ++i) {
    const GimbalState before = gimbal.state();
    std::optional<GimbalCommand> command;
    if (i % 40 < 30) command = rate(2.0 * std::sin(0.05 * i), 1.5 * std::cos(0.03 * i));
    if (i % 40 == 35) command = GimbalCommand{};
    gimbal.step(command);
    const GimbalState& after = gimbal.state();
    EXPECT_NEAR(after.pitch_rate, (after.pitch - before.pitch) / Gimbal::kStepS, 1e-12);
    EXPECT_NEAR(after.yaw_rate, (after.yaw - before.yaw) / Gimbal::kStepS, 1e-12);
    EXPECT_LE(std::abs(after.pitch), 80.0 * kRadPerDeg + 1e-12);
    EXPECT_LE(std::abs(after.yaw), 90.0 * kRadPerDeg + 1e-12);
    EXPECT_LE(std::abs(after.yaw_rate), 60.0 * kRadPerDeg + 1e-12);
  }
}

TEST(Gimbal, AtAnAngleLimitOnlyThePhantomRateIsNotZero) {
  Gimbal honest({}), phantom({}, true);
  for (int i = 0; i < 60; ++i) {
    honest.step(rate(0, 1.0));
    phantom.step(rate(0, 1.0));
  }
  EXPECT_EQ(honest.state().yaw, phantom.state().yaw);
  EXPECT_EQ(honest.state().yaw_rate, 0.0);
  EXPECT_EQ(phantom.state().yaw_rate, 1.0);
}

TEST(Gimbal, ALapsedRateCommandLeavesTheGimbalHoldingItsAngle) {
  Gimbal gimbal({});
  gimbal.step(rate(0.4, 0.0));
  gimbal.step({});
  gimbal.step({});
  EXPECT_EQ(gimbal.mode(), GimbalMode::rate);
  const double pitch = gimbal.state().pitch;
  gimbal.step({});
  EXPECT_EQ(gimbal.mode(), GimbalMode::angle);
  EXPECT_NEAR(gimbal.state().pitch, pitch, 1e-12);
  EXPECT_NEAR(gimbal.state().pitch_rate, 0.0, 1e-12);
}

TEST(Gimbal, ACommandedAngleIsReachedAndHeldWithoutFurtherCommands) {
  Gimbal gimbal({});
  gimbal.step(angle(0.7, -1.2));
  for (int i = 0; i < 40; ++i) gimbal.step({});
  EXPECT_NEAR(gimbal.state().pitch, 0.7, 1e-9);
  EXPECT_NEAR(gimbal.state().yaw, -1.2, 1e-9);
}

TEST(Gimbal, TheModeFollowsFromTheSignOfTheNumber) {
  EXPECT_EQ(gimbal_mode(1.0), GimbalMode::angle);
  EXPECT_EQ(gimbal_mode(1e-12), GimbalMode::angle);
  EXPECT_EQ(gimbal_mode(0.0), GimbalMode::freeze);
  EXPECT_EQ(gimbal_mode(-1e-7), GimbalMode::freeze);
  EXPECT_EQ(gimbal_mode(-1.0), GimbalMode::rate);
}

}  // namespace
}  // namespace skein::sim
