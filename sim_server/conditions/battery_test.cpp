#include "sim_server/conditions/battery.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "core/vehicle/rotor_power.hpp"
#include "sim_server/conditions/surroundings.hpp"
#include "sim_server/testing/test_flight.hpp"

namespace skein::sim {
namespace {

constexpr double kMission_s = 300.0;

BatteryConditions conditions(double endurance) { return {.endurance_missions = endurance}; }

TEST(Battery, ABatteryLetsItsVehicleHoverForItsEndurance) {
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

TEST(Battery, TheEnergyBalanceHoldsUnderAnyLoad) {
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
  EXPECT_NEAR(battery.given_j(), asked_j, 0.002 * asked_j) << "the last draw may have exceeded the remaining energy";
  EXPECT_NEAR(battery.capacity_wh() * 3600.0, full_j, 1e-6 * full_j);
  EXPECT_GT(battery.heat_j(), 0.0);
}

TEST(Battery, TheVoltageSagsUnderLoad) {
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
  EXPECT_NEAR(battery.status().voltage_v, 0.5 * open_v, 0.01 * open_v)
      << "at the greatest power that the battery can give";
}

TEST(Battery, ABatteryLosesTheChargeThatItsCurrentDraws) {
  Battery battery(conditions(1.0), test::vehicle_named("explorer"), kMission_s);
  double drawn_as = 0.0;
  for (const double power_w : {100.0, 400.0, 900.0, 1e9}) {
    battery.draw(power_w, 0.5);
    drawn_as += 0.5 * battery.status().current_a;
  }
  const BatteryStatus status = battery.status();
  EXPECT_NEAR(3600.0 * status.capacity_ah * (1.0 - status.charge), drawn_as, 1e-9 * drawn_as);
}

TEST(Battery, AnEmptyBatteryGivesNothing) {
  Battery battery(conditions(0.01), test::vehicle_named("photographer"), 1.0);
  while (!battery.empty()) battery.draw(100.0, 0.1);
  const double given_j = battery.given_j();
  battery.draw(100.0, 10.0);
  EXPECT_EQ(battery.given_j(), given_j);
  EXPECT_EQ(battery.charge(), 0.0);
  EXPECT_EQ(battery.status().current_a, 0.0);
}

/// Drawn flights of one UAV: it stands before its first flight, lands away from the station, then near it, twice.
class BatterySwap : public testing::TestWithParam<std::uint64_t> {
 protected:
  BatterySwap() {
    scenario_.station_position = {draw_.uniform(-50.0, 50.0), draw_.uniform(-50.0, 50.0), 0.3};
    scenario_.fleet.push_back({.name = "uav", .vehicle = test::vehicle_named("explorer")});
    scenario_.conditions.battery.endurance_missions = 0.5;
    scenario_.conditions.battery.swap_s = swap_s_;
    scenario_.conditions.battery.swap_within_m = within_m_;
  }
  /// The UAV stays for some time. @returns after how long it got a full battery [s]; nullopt if it got none.
  std::optional<double> stay(double off_m, double time_s, bool airborne) {
    const Tick from = tick_;
    std::optional<double> full_s;
    for (; tick_ < from + ticks(time_s); tick_ += ticks(scenario_.exchange_period_s)) {
      uav_->suffer(false, most_charge_, charge_lost_);
      uav_->note_place(tick_, scenario_.station_position + Vector3d(off_m, 0.0, airborne ? 9.0 : 0.0), airborne);
      if (!full_s && uav_->battery()->charge == 1.0) full_s = seconds(tick_ - from);
    }
    return full_s;
  }
  RandomStream draw_{GetParam(), "battery_swap", 0};
  const double swap_s_ = draw_.uniform(2.0, 40.0), within_m_ = draw_.uniform(5.0, 60.0);
  Scenario scenario_;
  std::optional<Surroundings> uav_;
  double most_charge_ = 1.0;  ///< limit that an active fault sets, see BatteryLoss
  Tick charge_lost_ = 0;      ///< when this fault began
  Tick tick_ = 0;
};

TEST_P(BatterySwap, AUavThatHasLandedNearTheStationGetsAFullBatteryOnce) {
  uav_.emplace(scenario_, 1, UavIndex{0});
  stay(0.0, 2.0 * swap_s_, false);
  EXPECT_EQ(uav_->battery_use().swaps, 0U) << "it has not flown";
  for (int flight = 1; flight <= 2; ++flight) {
    stay(0.0, 5.0, true);
    most_charge_ = draw_.uniform(0.05, 0.6);
    EXPECT_FALSE(stay(0.0, 1.5 * swap_s_, true)) << "in flight";
    EXPECT_FALSE(stay(within_m_ + 1.0, 1.5 * swap_s_, false)) << "too far away";
    EXPECT_FALSE(stay(within_m_ - 1.0, 0.5 * swap_s_, false)) << "too short";
    stay(0.0, 1.0, true);
    const auto full_s = stay(within_m_ - 1.0, 3.5 * swap_s_, false);
    ASSERT_TRUE(full_s);
    EXPECT_NEAR(*full_s, swap_s_, 0.06);
    EXPECT_EQ(uav_->battery_use().swaps, static_cast<std::uint64_t>(flight)) << "one swap for each landing";
    EXPECT_EQ(uav_->battery_use().last_in_flight, most_charge_);
    EXPECT_EQ(uav_->battery()->charge, 1.0) << "the fault drained only the previous battery, not this one";
  }
}

// If the UAV's program is away, the UAV stays on the ground, where its controller uses the battery.
TEST_P(BatterySwap, AUavThatStandsNearTheStationWithALowBatteryGetsAnother) {
  uav_.emplace(scenario_, 1, UavIndex{0});
  stay(0.0, 5.0, true);
  for (int swaps = 1; swaps <= 3; ++swaps) {
    most_charge_ = draw_.uniform(0.1, 0.9);
    const auto full_s = stay(0.0, 1.5 * swap_s_, false);
    ASSERT_TRUE(full_s) << swaps;
    EXPECT_EQ(uav_->battery_use().swaps, static_cast<std::uint64_t>(swaps));
  }
}

// Each fault begins when the previous one ends, so in every exchange a fault limits the charge.
TEST_P(BatterySwap, EachOfTwoEqualFaultsDrainsTheBatteryInTheUavOnce) {
  uav_.emplace(scenario_, 1, UavIndex{0});
  stay(0.0, 5.0, true);
  most_charge_ = draw_.uniform(0.1, 0.9);
  for (int faults = 1; faults <= 3; ++faults) {
    charge_lost_ = tick_;
    stay(0.0, 0.5 * swap_s_, true);
    EXPECT_DOUBLE_EQ(uav_->battery()->charge, most_charge_) << "fault " << faults;
    EXPECT_TRUE(stay(0.0, 1.5 * swap_s_, false)) << "the fault takes nothing from the new battery";
    EXPECT_EQ(uav_->battery()->charge, 1.0);
  }
}

TEST_P(BatterySwap, AUavWhoseBatteryIsEmptyGetsNoOther) {
  uav_.emplace(scenario_, 1, UavIndex{0});
  stay(0.0, 5.0, true);
  test::Flight flight(scenario_.fleet[UavIndex{0}].vehicle);
  flight.fly(1.0, test::hover_at({0, 0, 50}));
  uav_->suffer(false, 1e-9, 0);
  EXPECT_TRUE(uav_->spend(0, flight.vehicle(), flight.state())) << "it is empty now";
  EXPECT_FALSE(stay(0.0, 3.0 * swap_s_, false));
  EXPECT_EQ(uav_->battery_use().swaps, 0U);
}

TEST_P(BatterySwap, WithoutSwapsAUavGetsNoOtherBattery) {
  scenario_.conditions.battery.swap_s.reset();
  uav_.emplace(scenario_, 1, UavIndex{0});
  most_charge_ = 0.3;
  stay(0.0, 5.0, true);
  EXPECT_FALSE(stay(0.0, 60.0, false));
  EXPECT_EQ(uav_->battery_use().swaps, std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(Drawn, BatterySwap, testing::Range<std::uint64_t>(1, 7));

TEST(ElectricPower, AHoverNeedsThePowerOfMomentumTheory) {
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
