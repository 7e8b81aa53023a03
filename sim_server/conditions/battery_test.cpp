#include "sim_server/conditions/battery.hpp"

#include <gtest/gtest.h>

#include "core/random_stream.hpp"
#include "core/vehicle/rotor_power.hpp"
#include "sim_server/testing/test_flight.hpp"

namespace skein::sim {
namespace {

constexpr double kMission_s = 300.0;

BatteryConditions conditions(double endurance) { return {.endurance_missions = endurance}; }

TEST(Battery, LetsItsVehicleHoverAsLongAsItIsSaidTo) {
  for (const char* name : {"explorer", "photographer"}) {
    for (const double endurance : {0.5, 0.8, 1.5}) {
      const VehicleConfig vehicle = test::vehicle_named(name);
      Battery battery(conditions(endurance), vehicle, kMission_s);
      const double power_w = hover_power(vehicle, conditions(endurance));
      double time_s = 0.0;
      for (; !battery.empty(); time_s += 0.01) battery.draw(power_w, 0.01);
      EXPECT_NEAR(time_s, endurance * kMission_s, 0.01 * endurance * kMission_s) << name;
    }
  }
}

TEST(Battery, KeepsItsEnergyBalanceUnderAnyLoad) {
  const VehicleConfig vehicle = test::vehicle_named("explorer");
  Battery battery(conditions(0.8), vehicle, kMission_s);
  RandomStream draw(1, "battery_test", 0);
  double asked_j = 0.0;
  const double full_j = battery.left_j();
  while (!battery.empty()) {
    const double power_w = draw.uniform(0.0, 900.0), before = battery.charge();
    battery.draw(power_w, 0.05);
    asked_j += 0.05 * power_w;
    EXPECT_LE(battery.charge(), before);
    EXPECT_NEAR(battery.left_j() + battery.given_j() + battery.heat_j(), full_j, 1e-9 * full_j);
  }
  EXPECT_NEAR(battery.given_j(), asked_j, 0.002 * asked_j) << "the last draw may have been more than was left";
  EXPECT_NEAR(battery.capacity_wh() * 3600.0, full_j, 1e-6 * full_j);
  EXPECT_GT(battery.heat_j(), 0.0);
}

TEST(Battery, SagsUnderLoad) {
  const VehicleConfig vehicle = test::vehicle_named("explorer");
  const BatteryConditions config = conditions(1.0);
  Battery battery(config, vehicle, kMission_s);
  const double open_v = battery.open_voltage_v();
  EXPECT_NEAR(open_v, 6 * 4.2, 1e-9);
  battery.draw(hover_power(vehicle, config), 0.01);
  const double sag = (open_v - battery.status().voltage_v) / open_v;
  EXPECT_NEAR(sag, config.sag, 0.2 * config.sag);
  battery.draw(2.0 * hover_power(vehicle, config), 0.01);
  EXPECT_GT((open_v - battery.status().voltage_v) / open_v, 1.8 * sag);
  battery.draw(1e9, 0.01);
  EXPECT_NEAR(battery.status().voltage_v, 0.5 * open_v, 0.01 * open_v) << "the most that it can give";
  const BatteryStatus status = battery.status();
  EXPECT_NEAR(status.capacity_ah * status.charge, battery.charge() * status.capacity_ah, 1e-12);
}

TEST(Battery, AnEmptyOneGivesNothing) {
  Battery battery(conditions(0.01), test::vehicle_named("photographer"), 1.0);
  while (!battery.empty()) battery.draw(100.0, 0.1);
  const double given_j = battery.given_j();
  battery.draw(100.0, 10.0);
  EXPECT_EQ(battery.given_j(), given_j);
  EXPECT_EQ(battery.charge(), 0.0);
  EXPECT_EQ(battery.status().current_a, 0.0);
}

TEST(ElectricPower, OfAHoverIsThatOfMomentumTheory) {
  const VehicleConfig vehicle = test::vehicle_named("explorer");
  const BatteryConditions config = conditions(1.0);
  test::Flight flight(vehicle);
  flight.fly(10.0, test::hover_at({0, 0, 50}));
  const double still_w = electric_power(config, vehicle, flight.vehicle().rotor_thrusts_n(), Vector3d::Zero());
  EXPECT_NEAR(still_w, hover_power(vehicle, config), 0.02 * still_w);
  // In wind the rotors meet new air: the same thrust is cheaper. A climb costs its potential energy.
  EXPECT_LT(electric_power(config, vehicle, flight.vehicle().rotor_thrusts_n(), {8, 0, 0}), 0.9 * still_w);
  const double climb_w = electric_power(config, vehicle, flight.vehicle().rotor_thrusts_n(), {0, 0, 2});
  EXPECT_GT(climb_w, still_w + 0.4 * 2.0 * flight.thrust() / config.efficiency);
}

}  // namespace
}  // namespace skein::sim
