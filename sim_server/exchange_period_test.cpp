// Commands arrive once per exchange. With every exchange period, a UAV obeys a command until shortly after the next one
// is due.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/testing/test_flight.hpp"

namespace skein::sim {
namespace {

/// Exchange periods [ticks]: usual ones, and random ones, most of which are not multiples of a control step.
std::vector<Tick> periods() {
  std::vector<Tick> periods = {1, 20, 40, 80, 100, 200, 400};
  RandomStream random(1, "periods", 0);
  for (int i = 0; i < 8; ++i) periods.push_back(1 + static_cast<Tick>(random.uniform() * 399.0));
  return periods;
}

/// A fleet of an explorer and a photographer with this exchange period.
class Paced {
 public:
  explicit Paced(Tick period) {
    scenario_.file = "field.yaml";
    scenario_.exchange_period_s = seconds(period);
    scenario_.station_position = {-5, 0, 0.3};
    for (const char* type : {"explorer", "photographer"}) {
      scenario_.fleet.push_back({.name = type,
                                 .vehicle = test::vehicle_named(type),
                                 .start = {0.5, 10.0 * static_cast<double>(scenario_.fleet.size())}});
    }
    simulation_ = std::make_unique<Simulation>(scenario_, Scene{}, 0);
  }
  /// @param pilot  returns the command of (uav, t), called in each exchange. @param watch  called after each exchange.
  template <class Pilot, class Watch>
  void fly(double duration_s, const Pilot& pilot, const Watch& watch) {
    const Tick end = simulation_->tick() + ticks(duration_s);
    while (simulation_->tick() < end) {
      for (const UavIndex i : FirstUavs(simulation_->size())) {
        simulation_->command_trajectory(i, pilot(i, seconds(simulation_->tick())));
      }
      simulation_->advance();
      watch();
    }
  }
  Simulation& simulation() { return *simulation_; }

 private:
  Scenario scenario_;
  std::unique_ptr<Simulation> simulation_;
};

TEST(ExchangePeriod, AFleetFliesItsPathWithAnyPeriod) {
  // Climbs, then flies 24 m ahead by commands that have only a position, as patrol's way-points do.
  for (const Tick period : periods()) {
    Paced fleet(period);
    const auto lane = [](UavIndex uav) { return 10.0 * static_cast<double>(uav); };
    fleet.fly(
        8.0,
        [&](UavIndex i, double) {
          return TrajectoryCommand{.p_WB = {0.5, lane(i), 6}};
        },
        [] {});
    double off = 0.0, fastest = 0.0;
    fleet.fly(
        16.0,
        [&](UavIndex i, double) {
          return TrajectoryCommand{.p_WB = {24.5, lane(i), 6}};
        },
        [&] {
          for (const UavIndex i : FirstUavs(2)) {
            const RigidBodyState& state = fleet.simulation().uav(i).state;
            off = std::max({off, std::abs(state.p_WB.y() - lane(i)), std::abs(state.p_WB.z() - 6.0)});
            fastest = std::max(fastest, state.v_WB.x());
          }
        });
    for (const UavIndex i : FirstUavs(2)) {
      const Vector3d& p = fleet.simulation().uav(i).state.p_WB;
      EXPECT_LT((p - Vector3d(24.5, lane(i), 6)).norm(), 0.2) << seconds(period) << " s, UAV " << i;
    }
    EXPECT_LT(off, 0.3) << seconds(period) << " s";
    EXPECT_GT(fastest, 4.0) << seconds(period) << " s: it does not stop on the way";
  }
}

TEST(ExchangePeriod, AUavKeepsItsVelocityBetweenCommands) {
  for (const Tick period : periods()) {
    Paced fleet(period);
    const auto up = [](UavIndex i, double) { return TrajectoryCommand{.p_WB = {0.5, 10.0 * i, 6}}; };
    fleet.fly(8.0, up, [] {});
    const auto ahead = [](UavIndex, double) { return TrajectoryCommand{.v_WB = {2, 0, 0}}; };
    fleet.fly(4.0, ahead, [] {});
    double slowest = 10.0;
    fleet.fly(4.0, ahead, [&] { slowest = std::min(slowest, fleet.simulation().uav(UavIndex{0}).state.v_WB.x()); });
    EXPECT_GT(slowest, 1.7) << seconds(period) << " s";
  }
}

TEST(ExchangePeriod, AGimbalKeepsTurningBetweenRateCommands) {
  for (const Tick period : periods()) {
    Paced fleet(period);
    Simulation& simulation = fleet.simulation();
    while (simulation.tick() < ticks(2.0)) {
      simulation.command_gimbal(UavIndex{0}, {GimbalMode::rate, 0.0, 0.4});
      simulation.advance();
    }
    EXPECT_NEAR(simulation.uav(UavIndex{0}).gimbal.yaw, 0.4 * seconds(simulation.tick()), 0.4 * 0.051)
        << seconds(period);
    for (int i = 0; i * period < ticks(2.0); ++i) simulation.advance();
    const double yaw = simulation.uav(UavIndex{0}).gimbal.yaw;
    simulation.advance();
    EXPECT_EQ(simulation.uav(UavIndex{0}).gimbal.yaw, yaw)
        << "without another command it stops, " << seconds(period) << " s";
  }
}

TEST(ExchangePeriod, AUavHoldsATenthOfASecondAfterTheNextCommandWasDue) {
  for (const Tick period : periods()) {
    Vehicle vehicle(test::vehicle_named("photographer"), {}, kTickS, period);
    const RigidBodyState state{.p_WB = {0, 0, 50}};
    const Tick last = 3 * period;  // last command; commands take effect at the next control step
    std::optional<TrajectoryCommand> waiting;
    std::optional<Tick> lapsed;
    for (Tick tick = 0; !lapsed && tick < last + 2000; ++tick) {
      if (tick % period == 0 && tick <= last) waiting = TrajectoryCommand{.v_WB = {1, 0, 0}};
      if (tick % kControlTicks != 0) continue;
      vehicle.control(tick, state, std::exchange(waiting, std::nullopt), std::nullopt);
      if (tick <= last + period) {
        ASSERT_EQ(vehicle.mode(), ControlMode::moving) << seconds(period) << " s, tick " << tick;
      }
      if (vehicle.mode() == ControlMode::hold) lapsed = tick;
    }
    ASSERT_TRUE(lapsed);
    EXPECT_GT(*lapsed, last + std::max(period, kControlTicks)) << seconds(period);
    EXPECT_LE(*lapsed, last + std::max(period, kControlTicks) + 4 * kControlTicks) << seconds(period);
    if (period != kControlTicks) continue;
    EXPECT_EQ(*lapsed, last + 60) << "the reference's 0.15 s";
  }
}

}  // namespace
}  // namespace skein::sim
