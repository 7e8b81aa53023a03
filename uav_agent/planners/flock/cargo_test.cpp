// The value of the captures that a UAV of the planner flock carries.
#include "uav_agent/planners/flock/cargo.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

TEST(FlockCargo, CapturesAddUpUntilAllAreDelivered) {
  FlockCargo cargo;
  cargo.update(0.5, 1);
  cargo.update(2.0, 2);
  cargo.update(0.0, 2);
  EXPECT_DOUBLE_EQ(cargo.stake().value, 2.5);
  cargo.update(0.0, 0);
  EXPECT_DOUBLE_EQ(cargo.stake().value, 0.0);
  cargo.update(1.0, 1);
  EXPECT_DOUBLE_EQ(cargo.stake().value, 1.0);
}

TEST(FlockCargo, PartlyDeliveredCapturesLeaveTheirShare) {
  RandomStream random(1, "cargo", 0);
  for (int i = 0; i < 200; ++i) {
    FlockCargo cargo;
    const std::size_t all = 1 + random.bits() % 20, left = random.bits() % (all + 1);
    const double gained = random.uniform(0.1, 50.0), then = random.uniform(0.1, 5.0);
    cargo.update(gained, all);
    cargo.update(0.0, left);
    EXPECT_NEAR(cargo.stake().value, gained * static_cast<double>(left) / static_cast<double>(all), 1e-9);
    cargo.update(then, left + 1);
    EXPECT_NEAR(cargo.stake().value, gained * static_cast<double>(left) / static_cast<double>(all) + then, 1e-9);
  }
}

TEST(FlockCargo, TheGainFollowsTheRoutesAndFadesWithoutThem) {
  FlockCargo cargo;
  for (int i = 0; i < 40; ++i) cargo.note(2.0);
  EXPECT_NEAR(cargo.stake().gain_per_s, 2.0, 0.01);
  for (int i = 0; i < 40; ++i) cargo.note(0.0);
  EXPECT_NEAR(cargo.stake().gain_per_s, 0.0, 0.01);
}

}  // namespace
}  // namespace skein::agent
