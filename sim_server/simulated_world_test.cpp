// Signals that the server knows during a run, and for which faults may wait.
#include "sim_server/simulated_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/expressions/expression_parser.hpp"
#include "sim_server/testing/test_flight.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// Three UAVs in front of a wall at x = 12; the third one stays on the ground.
class LiveSignalsTest : public testing::Test {
 protected:
  LiveSignalsTest() {
    scenario_.station_position = {-5, 0, 0.3};
    test::add_box(scene_.mesh, {12.5, 0, 10}, {1, 20, 20});
    for (int y = -8; y <= 8; ++y) scene_.points.push_back({{12.0F, static_cast<float>(y), 5.0F}, {-1, 0, 0}});
    for (const auto& [name, y] : {std::pair("a", 0.0), std::pair("b", 6.0), std::pair("c", -9.0)}) {
      scenario_.fleet.push_back({.name = name, .vehicle = test::vehicle_named("photographer"), .start = {0, y}});
    }
  }

  double value(const std::string& text) const {
    const SignalNames names(scenario_);
    std::vector<SignalUse> signals;
    parse_condition(text + " == " + text, {.names = names, .live_only = true}, signals);
    return signals_->value(signals.at(0));
  }

  void fly(double duration_s, const std::function<void()>& watch) {
    simulation_ = std::make_unique<Simulation>(scenario_, scene_, 0, faults_);
    world_ = std::make_unique<SimulatedWorld>(*simulation_);
    signals_ = std::make_unique<signals::LiveSignals>(scenario_, *world_);
    for (int k = 0; seconds(20 * k) < duration_s; ++k) {
      const double t = seconds(20 * k);
      simulation_->command_trajectory(UavIndex{0}, {.p_WB = {6, 3.0 * std::sin(0.5 * t), 5}});
      simulation_->command_trajectory(UavIndex{1}, {.p_WB = {4, 6, 5}});
      simulation_->advance();
      signals_->end_step([&](const std::string& name) { return !away_.contains(name); });
      watch();
    }
  }
  const UavView& uav(std::size_t i) const { return simulation_->uav(UavIndex{i}); }

  Scenario scenario_;
  Scene scene_;
  FaultPlan faults_;
  std::set<std::string> away_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<SimulatedWorld> world_;
  std::unique_ptr<signals::LiveSignals> signals_;
};

TEST_F(LiveSignalsTest, SignalsAgreeWithTheSimulatedWorld) {
  faults_.faults.push_back({.at_s = 5.0, .until_s = 7.0, .action = Blackout{"a"}});
  double captured = 0.0;
  std::size_t with_fault = 0;
  fly(12.0, [&] {
    const auto between = [&](std::size_t i, std::size_t j) { return (uav(i).state.p_WB - uav(j).state.p_WB).norm(); };
    EXPECT_EQ(value("time"), seconds(simulation_->tick()));
    EXPECT_EQ(value("x(a)"), uav(0).state.p_WB.x());
    EXPECT_EQ(value("z(b)"), uav(1).state.p_WB.z());
    EXPECT_EQ(value("speed(a)"), uav(0).state.v_WB.norm());
    EXPECT_EQ(value("separation"), std::min({between(0, 1), between(0, 2), between(1, 2)}));
    EXPECT_EQ(value("separation(a)"), std::min(between(0, 1), between(0, 2)));
    EXPECT_EQ(value("separation(c, b)"), between(1, 2));
    EXPECT_NEAR(value("clearance(a)"), 12.0 - uav(0).state.p_WB.x(), 1e-3);
    EXPECT_EQ(value("charge(a)"), 1.0) << "a UAV without a battery counts as full";
    EXPECT_EQ(value("clearance"), std::min({value("clearance(a)"), value("clearance(b)"), value("clearance(c)")}));
    EXPECT_EQ(value("faults"), simulation_->tick() >= ticks(5.0) && simulation_->tick() < ticks(7.0) ? 1.0 : 0.0);
    with_fault += value("faults") > 0.0;
    for (const CaptureEvent& event : simulation_->events().captures) captured += event.report.has_value();
    EXPECT_EQ(value("captures"), captured);
    EXPECT_EQ(value("held"), captured - value("acknowledged"));
  });
  EXPECT_EQ(with_fault, 40U);
  EXPECT_GT(captured, 3.0) << "else the test shows little";
  signals_->add_release(UavIndex{0});
  EXPECT_EQ(value("acknowledged(a)"), 1.0);
  EXPECT_EQ(value("acknowledged(b)"), 0.0);
  EXPECT_EQ(value("held"), captured - 1.0);
}

TEST_F(LiveSignalsTest, ChargeIsThatOfTheUavsBattery) {
  scenario_.duration_s = 60.0;
  scenario_.conditions.battery = conditions_preset("harsh").battery;
  fly(5.0, [&] {
    for (const auto& [name, i] : {std::pair("a", 0U), std::pair("c", 2U)}) {
      EXPECT_EQ(value("charge(" + std::string(name) + ")"), uav(i).battery->charge);
    }
  });
  EXPECT_LT(value("charge(a)"), 0.95);
}

TEST_F(LiveSignalsTest, AProgramThatComesBackCountsAsRestarted) {
  int step = 0;
  away_ = {"b", "gcs"};
  fly(3.0, [&] {
    ++step;
    const bool first = step <= 10, second = step > 10 && step <= 20, third = step > 20 && step <= 30;
    EXPECT_EQ(value("restarts(a)"), first || second ? 0.0 : third ? 1.0 : 2.0) << step;
    EXPECT_EQ(value("restarts(b)"), 0.0) << "b has only joined for the first time";
    EXPECT_EQ(value("restarts"), value("restarts(a)"));
    EXPECT_EQ(value("leaves(a)"), step <= 10 ? 0.0 : step < 30 ? 1.0 : 2.0) << step;
    if (step == 10) away_ = {"a", "gcs"};
    if (step == 20) away_ = {"gcs"};
    if (step == 29) away_ = {"a"};
    if (step == 30) away_ = {};
  });
}

}  // namespace
}  // namespace skein::sim
