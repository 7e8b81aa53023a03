#include "core/vehicle/rotor_power.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_reader.hpp"

namespace skein {
namespace {

double hover_velocity(double thrust_n, double area_m2) { return std::sqrt(thrust_n / (2.0 * kAirDensity * area_m2)); }

TEST(RotorPower, HoversWithTheIdealPowerOfMomentumTheory) {
  // T^(3/2) / sqrt(2 rho A): Leishman, eq. 2.15.
  for (const auto& [thrust_n, area_m2] : {std::pair(5.7, 0.1257), {15.4, 0.2235}, {0.5, 0.01}}) {
    const double power = std::pow(thrust_n, 1.5) / std::sqrt(2.0 * kAirDensity * area_m2);
    EXPECT_NEAR(ideal_power(thrust_n, area_m2, 0.0, 0.0), power, 1e-9 * power);
  }
}

TEST(RotorPower, TheInducedVelocitySolvesGlauertsEquation) {
  RandomStream draw(1, "rotor_power_test", 0);
  for (int i = 0; i < 1000; ++i) {
    const double thrust_n = draw.uniform(0.1, 40.0), area_m2 = draw.uniform(0.01, 0.5);
    const double across = draw.uniform(0.0, 25.0), climb = draw.uniform(0.0, 8.0);
    const double v = induced_velocity(thrust_n, area_m2, across, climb);
    const double h = hover_velocity(thrust_n, area_m2);
    EXPECT_NEAR(v * std::hypot(across, climb + v), h * h, 1e-9 * h * h);
  }
}

/// induced_velocity() stops early once a Newton step changes nothing. The result must have the same bits as that of all
/// eight steps, because digests of runs with batteries depend on it.
TEST(RotorPower, TheInducedVelocityIsThatOfEightStepsBitForBit) {
  RandomStream draw(2, "rotor_power_test", 0);
  for (int i = 0; i < 20'000; ++i) {
    const double thrust_n = draw.uniform(0.0, 40.0), area_m2 = draw.uniform(0.01, 0.5);
    const double across = i % 5 == 0 ? 0.0 : draw.uniform(0.0, 25.0), climb = draw.uniform(-4.0, 8.0);
    const double hover2 = thrust_n / (2.0 * kAirDensity * area_m2);
    double v = std::sqrt(hover2);
    for (int step = 0; step < 8; ++step) {
      const double through = std::max(climb, 0.0) + v, total = std::hypot(across, through);
      v -= (v * total - hover2) / (total + v * through / total);
    }
    ASSERT_EQ(induced_velocity(thrust_n, area_m2, across, climb), v) << i;
  }
}

TEST(RotorPower, FallsWithForwardSpeedAndRisesWithClimb) {
  double before = ideal_power(5.7, 0.1257, 0.0, 0.0);
  for (const double across : {2.0, 5.0, 10.0, 20.0}) {
    const double power = ideal_power(5.7, 0.1257, across, 0.0);
    EXPECT_LT(power, before) << across;
    before = power;
  }
  // v_i = v_h^2 / V at high speed: Leishman, eq. 2.121.
  const double h = hover_velocity(5.7, 0.1257);
  EXPECT_NEAR(induced_velocity(5.7, 0.1257, 60.0, 0.0), h * h / 60.0, 1e-4);
  // Climbing: v_i / v_h = -V_c / (2 v_h) + sqrt((V_c / (2 v_h))^2 + 1): eq. 2.86.
  const double c = 3.0 / (2.0 * h);
  EXPECT_NEAR(induced_velocity(5.7, 0.1257, 0.0, 3.0), h * (-c + std::sqrt(c * c + 1.0)), 1e-9);
  EXPECT_EQ(ideal_power(0.0, 0.1257, 3.0, 1.0), 0.0);
  EXPECT_EQ(ideal_power(5.7, 0.0, 0.0, -9.0), 0.0) << "a descending rotor returns no power";
}

TEST(RotorPower, TheDefaultEfficiencyIsThatOfAMatrice300) {
  // 6.3 kg on four rotors of 21 inches hover for 55 minutes on two packs of 274 Wh (DJI's data sheet).
  const double area_m2 = std::numbers::pi * std::pow(0.5 * 21.0 * 0.0254, 2);
  const double ideal = 4.0 * ideal_power(6.3 * kStandardGravity / 4.0, area_m2, 0.0, 0.0);
  const double electric = 2.0 * 274.0 * 60.0 / 55.0;
  EXPECT_NEAR(BatteryConditions{}.efficiency, ideal / (electric - BatteryConditions{}.avionics_w), 0.02);
}

TEST(RotorPower, BundledVehiclesHoverWith50To800Watts) {
  for (const char* name : {"explorer", "photographer"}) {
    const VehicleConfig vehicle = load_vehicle(name, default_config_dir());
    const double power = hover_power(vehicle, {});
    EXPECT_GT(power, 50.0) << name;
    EXPECT_LT(power, 800.0) << name;
  }
}

}  // namespace
}  // namespace skein
