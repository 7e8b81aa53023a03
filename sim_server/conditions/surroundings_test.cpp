// The scenario's conditions in whole simulations.
#include "sim_server/conditions/surroundings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

#include "core/config/config_node.hpp"
#include "core/vehicle/rotor_power.hpp"
#include "sim_server/conditions/path_loss.hpp"
#include "sim_server/points_shown.hpp"
#include "sim_server/run_digest.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/testing/test_flight.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// One or two UAVs that hover over a field with a wall far away.
class Windy : public testing::Test {
 protected:
  Windy() {
    scenario_.file = "windy.yaml";
    scenario_.station_position = {-5, 0, 0.3};
    scenario_.duration_s = 60.0;
    test::add_box(scene_.mesh, {12.5, 0, 10}, {1, 20, 20});
    for (int z = 2; z <= 18; ++z) scene_.points.push_back({{12.0F, 0.0F, static_cast<float>(z)}, {-1, 0, 0}});
    add("explorer", 0, 0);
  }
  void add(const std::string& type, double x, double y) {
    scenario_.fleet.push_back({.name = "uav" + std::to_string(scenario_.fleet.size()),
                               .vehicle = test::vehicle_named(type),
                               .start = {x, y}});
  }
  Simulation& start(std::uint64_t seed = 1, const FaultPlan& faults = {}) {
    simulation_ = std::make_unique<Simulation>(scenario_, scene_, seed, faults);
    return *simulation_;
  }
  /// All UAVs hover above their starts. @returns the digest.
  std::string hover(
      double until_s, const std::function<void()>& watch = [] {}) {
    RunDigest digest(scenario_.uav_names());
    while (seconds(simulation_->tick()) < until_s - 1e-9) {
      for (const UavIndex i : scenario_.uavs()) {
        const Vector2d& start = scenario_.fleet[i].start;
        simulation_->command_trajectory(i, {.p_WB = {start.x() + 0.1, start.y(), 8.0}});
      }
      simulation_->advance();
      digest.add(simulation_->digest_input());
      watch();
    }
    return digest.hex();
  }
  const UavView& uav(std::size_t i = 0) const { return simulation_->uav(UavIndex{i}); }

  Scenario scenario_;
  Scene scene_;
  std::unique_ptr<Simulation> simulation_;
};

TEST_F(Windy, AWindOfZeroChangesNoBit) {
  add("photographer", 0, 4);
  start();
  const std::string without = hover(12.0);
  scenario_.conditions.wind = conditions_preset("harsh").wind;
  scenario_.conditions.wind.mean_mps = 0.0;
  start();
  EXPECT_EQ(hover(12.0), without);
  scenario_.conditions.wind.mean_mps = 1.0;
  start();
  EXPECT_NE(hover(12.0), without);
}

TEST_F(Windy, TheSameSeedFliesTheSameAndAnotherDoesNot) {
  scenario_.conditions = conditions_preset("harsh");
  start(3);
  const std::string digest = hover(15.0);
  start(3);
  EXPECT_EQ(hover(15.0), digest);
  start(4);
  EXPECT_NE(hover(15.0), digest);
  start(0);
  const std::string nominal = hover(15.0);
  scenario_.conditions = {};
  start(0);
  EXPECT_NE(hover(15.0), nominal) << "seed 0 draws wind, too";
}

TEST_F(Windy, WindPushesAUavDownwindUntilItLeansIntoIt) {
  scenario_.conditions.wind = {.mean_mps = 8.0, .from_deg = 0.0, .turbulence = 0.0};  // from the east
  Simulation& sim = start();
  double most_off_m = 0.0;
  hover(25.0, [&] { most_off_m = std::max(most_off_m, 0.1 - uav().state.p_WB.x()); });
  EXPECT_GT(most_off_m, 0.15) << "to the west";
  ASSERT_TRUE(sim.uav(UavIndex{0}).airborne);
  // In equilibrium, the horizontal component of the thrust balances the drag of rotors and body.
  const Vector3d v_A(WindProfile(scenario_.conditions.wind).mean(8.0), 0, 0);
  const double body_n = body_drag(scenario_.conditions.wind.body_drag_area_m2, v_A).norm();
  const VehicleConfig& vehicle = scenario_.fleet[UavIndex{0}].vehicle;
  const double weight_n = mass_properties(vehicle).mass_kg * kWorldGravity;
  const double rotor_rad_s = std::sqrt(weight_n / (kRotors * vehicle.rotor_force_constant));
  const double rotors_n = kRotors * vehicle.rotor_drag * rotor_rad_s * v_A.norm();
  const Vector3d up_W = uav().state.q_WB * Vector3d::UnitZ();
  EXPECT_NEAR(up_W.x() / up_W.z(), (body_n + rotors_n) / weight_n, 0.15 * (body_n + rotors_n) / weight_n);
  EXPECT_NEAR(up_W.y(), 0.0, 0.01);
}

TEST_F(Windy, AGustActsEvenWithoutAnyWind) {
  const FaultPlan faults{"test.yaml", "", "", {{.at_s = 12.0, .until_s = 13.0, .action = Gust{"uav0", {0, 12, 0}}}}};
  start(1, faults);
  double most_m = 0.0, before_m = 0.0;
  hover(16.0, [&] {
    const double t = seconds(simulation_->tick()), y = uav().state.p_WB.y() - scenario_.fleet[UavIndex{0}].start.y();
    if (t <= 12.0 && t > 11.0) before_m = std::max(before_m, std::abs(y));
    if (t > 12.0) most_m = std::max(most_m, y);
  });
  EXPECT_GT(most_m, before_m + 0.15) << "along the gust";
}

TEST_F(Windy, AFaultStrengthensTheWindForATime) {
  scenario_.conditions.wind = {.mean_mps = 4.0, .from_deg = 180.0};
  const ConfigNode wind = parse_config_document("{wind: {mean_mps: 10}}", "").root;
  const FaultPlan faults{"test.yaml", "", "", {{.at_s = 20.0, .until_s = 30.0, .action = ConditionsChange{wind}}}};
  start(1, faults);
  const auto tilt_at = [&](double time_s) {
    hover(time_s);
    const Vector3d up_W = uav().state.q_WB * Vector3d::UnitZ();
    return up_W.x() / up_W.z();
  };
  const double before = tilt_at(20.0), during = tilt_at(30.0), after = tilt_at(45.0);
  EXPECT_LT(before, 0.0) << "against the wind";
  EXPECT_LT(during, 2.3 * before) << "drag of the rotors by the speed, of the body by its square";
  EXPECT_NEAR(after, before, 0.05 * std::abs(before));
}

TEST_F(Windy, WithoutAFixAUavKnowsLessUntilTheFaultEnds) {
  scenario_.conditions.odometry = conditions_preset("breezy").odometry;
  const FaultPlan faults{"test.yaml", "", "", {{.at_s = 15.0, .until_s = 30.0, .action = FixLoss{"uav0"}}}};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::vector<Vector3d> told_m, untouched_m;
    for (auto* sigmas : {&untouched_m, &told_m}) {
      sigmas == &told_m ? start(seed, faults) : start(seed);
      for (const double time_s : {14.9, 29.9, 35.0}) {
        hover(time_s);
        sigmas->push_back(uav().uncertainty.position_m);
      }
    }
    EXPECT_EQ(told_m[0], untouched_m[0]);
    EXPECT_GT(told_m[1].x(), 0.1 * std::sqrt(14.0)) << "the random walk alone reaches this";
    EXPECT_EQ(told_m[2], untouched_m[2]) << "as if the fault had not happened";
  }
}

TEST_F(Windy, ABatteryThatLosesChargeDoesNotGetItBack) {
  add("photographer", 0, 4);
  scenario_.conditions.battery.endurance_missions = 2.0;
  const FaultPlan faults{"test.yaml",
                         "",
                         "",
                         {{.at_s = 15.0, .until_s = 20.0, .action = BatteryLoss{"uav0", 0.2}},
                          {.at_s = 25.0, .until_s = {}, .action = BatteryLoss{"uav1", 0.0}}}};
  start(1, faults);
  hover(15.0);
  EXPECT_GT(uav().battery->charge, 0.8);
  hover(15.1);
  EXPECT_NEAR(uav().battery->charge, 0.2, 0.001);
  hover(24.0);
  EXPECT_NEAR(uav().battery->charge, 0.2 - 9.0 / 120.0, 0.01) << "what a hover costs, of two missions of 60 s";
  EXPECT_TRUE(uav(1).alive);
  hover(35.0);
  EXPECT_TRUE(uav().alive);
  EXPECT_FALSE(uav(1).alive) << "an empty battery lets it fall";
}

TEST_F(Windy, SensorsAndRadioAreAsBeforeOnceAChangeEnds) {
  add("photographer", 0, 4);
  scenario_.conditions.radio = conditions_preset("breezy").radio;
  const ConfigNode change = parse_config_document("{lidar: {reflectivity: 0.002}, radio: {power_dbm: -30}}", "").root;
  const FaultPlan faults{"test.yaml", "", "", {{.at_s = 15.0, .until_s = 20.0, .action = ConditionsChange{change}}}};
  Simulation& sim = start(1, faults);
  std::vector<double> points;
  std::vector<int> linked;
  const auto look_until = [&](double time_s) {
    double sum = 0.0;
    int scans = 0;
    hover(time_s, [&] {
      for (const LidarEvent& event : sim.events().scans) {
        sum += static_cast<double>(event.scan.points_W.size());
        ++scans;
      }
    });
    points.push_back(sum / std::max(1, scans));
    linked.push_back(sim.links().at(node_of_uav(UavIndex{0}), node_of_uav(UavIndex{1})));
  };
  hover(10.0);
  for (const double time_s : {14.9, 20.0 - 0.1, 25.0}) look_until(time_s);
  EXPECT_LT(points[1], 0.5 * points[0]) << "a wet, dark wall reflects less";
  EXPECT_NEAR(points[2], points[0], 0.1 * points[0]) << "the counts vary as the servo swings";
  EXPECT_GT(linked[0], 0);
  EXPECT_EQ(linked[1], 0);
  EXPECT_EQ(linked[2], linked[0]);
}

TEST_F(Windy, AHoverCostsTheEnergyOfMomentumTheory) {
  scenario_.conditions.battery.endurance_missions = 1.0;
  scenario_.duration_s = 100.0;
  start();
  hover(30.0);
  const double begun_charge = uav().battery->charge;
  hover(60.0);
  EXPECT_NEAR(begun_charge - uav().battery->charge, 0.3, 0.015) << "30 of 100 s; a full cell gives more a coulomb";
  const double hover_w = hover_power(scenario_.fleet[UavIndex{0}].vehicle, scenario_.conditions.battery);
  EXPECT_NEAR(uav().battery_use.mean_power_w, hover_w, 0.04 * hover_w) << "with its climb";
}

TEST_F(Windy, AnEmptyBatteryLetsTheUavFall) {
  add("photographer", 0, 4);
  scenario_.conditions.battery.endurance_missions = 0.3;
  Simulation& sim = start();
  std::vector<Collision> collisions;
  hover(30.0, [&] {
    const auto& news = sim.events().collisions;
    collisions.insert(collisions.end(), news.begin(), news.end());
  });
  ASSERT_EQ(collisions.size(), 2U);
  for (const Collision& collision : collisions) {
    EXPECT_TRUE(collision.battery_empty);
    EXPECT_EQ(collision.with.kind, BodyId::Kind::ground);
    EXPECT_NEAR(seconds(collision.tick), 20.0, 4.0) << "18 s of hover, and the fall";
    EXPECT_FALSE(sim.uav(collision.uav).alive);
  }
  EXPECT_EQ(uav().battery->charge, 0.0);
  EXPECT_TRUE(uav().battery_use.empty);
}

TEST_F(Windy, OnTheGroundAnEmptyBatteryIsNoCollision) {
  scenario_.conditions.battery.endurance_missions = 0.4;
  Simulation& sim = start();
  hover(8.0);
  std::size_t collisions = 0;
  for (int k = 0; k < 900; ++k) {  // down slowly, then stay
    const double z = std::max(0.05, 8.0 - 0.05 * k);
    sim.command_trajectory(UavIndex{0}, {.p_WB = {0.1, 0.0, z}, .v_WB = {0, 0, z > 0.05 ? -1.0 : 0.0}});
    sim.advance();
    collisions += sim.events().collisions.size();
  }
  EXPECT_EQ(collisions, 0U);
  EXPECT_TRUE(uav().alive);
  EXPECT_FALSE(uav().airborne);
}

TEST_F(Windy, TheUavFliesByItsOdometryAndIsNotToldTheTruth) {
  scenario_.conditions.odometry = {
      .horizontal_sigma_m = 0.5, .vertical_sigma_m = 0.2, .yaw_sigma_deg = 3.0, .mean_fix_s = {}};
  Simulation& sim = start(2);
  hover(25.0);
  const Vector3d wanted_W(0.1, 0.0, 8.0);
  const double truly_off_m = (uav().state.p_WB - wanted_W).norm(), told_off_m = (uav().told.p_WB - wanted_W).norm();
  EXPECT_LT(told_off_m, 0.12);
  EXPECT_GT(truly_off_m, 0.2) << "the UAV is off by the error that seed 2 draws";
  EXPECT_GT(uav().uncertainty.position_m.x(), 0.49);
  // The LiDAR places a point of the wall's near side relative to the odometry: it is off by the odometry's error.
  const Isometry3d X_told_W = uav().told.X_WB() * uav().state.X_WB().inverse();
  std::size_t on_wall = 0, points = 0;
  while (sim.events().scans.empty() && seconds(sim.tick()) < 30.0) sim.advance();
  const Isometry3d X_W_told = (uav().told.X_WB() * uav().state.X_WB().inverse()).inverse();
  for (const Eigen::Vector3f& p_told : sim.events().scans.at(0).scan.points_W) {
    const Vector3d p_W = X_W_told * p_told.cast<double>();
    if (std::abs(p_W.y()) > 9.0 || p_W.z() < 1.0 || p_W.x() < 5.0) continue;
    ++points;
    on_wall += std::abs(p_W.x() - 12.0) < 0.1 ? 1 : 0;
  }
  ASSERT_GT(points, 50U);
  EXPECT_EQ(on_wall, points);
  EXPECT_GT((X_told_W * Vector3d(12, 0, 8) - Vector3d(12, 0, 8)).norm(), 0.2);
}

TEST_F(Windy, ALinkNeedsPowerBesideLineOfSight) {
  Simulation& ideal = start();
  hover(4.0);
  EXPECT_EQ(ideal.links().at(kStationNode, Node{1}), 1) << "no level without path loss";
  scenario_.conditions.radio = conditions_preset("breezy").radio;
  Simulation& near = start();
  hover(4.0);
  EXPECT_EQ(near.links().at(kStationNode, Node{1}), kRadioRates.size());
  scenario_.conditions.radio.power_dbm = -30.0;
  EXPECT_EQ(start().links().at(kStationNode, Node{1}), 0);
}

TEST_F(Windy, TheQualityOfALinkIsItsReceivedPowerAndItsRate) {
  add("photographer", 40, 30);
  add("photographer", -60, -80);
  EXPECT_FALSE(start().link_quality(Node{1}, Node{2})) << "no path loss";
  scenario_.conditions.radio = conditions_preset("harsh").radio;
  const FaultPlan faults{"test.yaml", "", "", {{.at_s = 3.0, .until_s = 4.0, .action = Blackout{"uav1"}}}};
  std::set<double> rates;
  int closed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Simulation& sim = start(seed, faults);
    hover(4.5, [&] {
      for (const Node a : scenario_.nodes()) {
        for (const Node b : scenario_.nodes()) {
          const auto quality = sim.link_quality(a, b);
          const std::uint8_t level = sim.open_links().at(a, b);
          ASSERT_EQ(quality.has_value(), level > 0);
          closed += quality ? 0 : 1;
          if (!quality) continue;
          EXPECT_EQ(PathLoss::level(quality->received_dbm), level);
          EXPECT_EQ(quality->received_dbm, sim.link_quality(b, a)->received_dbm);
          EXPECT_EQ(quality->rate_bit_s, 0.05 * kRadioRates.at(level - 1U).rate_bit_s);
          rates.insert(quality->rate_bit_s);
        }
      }
    });
  }
  EXPECT_GE(rates.size(), 3U) << "else the test shows little";
  EXPECT_GE(closed, 20 * 20 * (4 + 6)) << "links of all nodes to themselves, and of the node without a radio";
}

TEST_F(Windy, LongExposuresAndVibrationBlurPicturesAndAShutterDelayMakesThemLate) {
  struct Seen {
    float best = 0.0F;       ///< of a point
    double mean_blur = 0.0;  ///< quality of all pictures of points: 1 is sharp
    Tick first = 0;          ///< picture
  };
  const auto flown_with = [&](const CameraConditions& camera) {
    scenario_.conditions.camera = camera;
    Simulation& sim = start();
    Seen seen;
    int detections = 0;
    for (int k = 0; k < 240; ++k) {  // past the wall's points, at 2 m/s
      sim.command_trajectory(UavIndex{0}, {.p_WB = {6.0, -6.0 + 0.1 * std::max(0, k - 140), 8.0}, .v_WB = {0, 2, 0}});
      sim.command_gimbal(UavIndex{0}, {GimbalMode::angle, 0.0, 0.0});
      sim.advance();
      for (const CaptureEvent& event : sim.events().captures) {
        if (seen.first == 0) seen.first = event.capture.tick;
        for (const Detection& detection : event.capture.detections) {
          seen.best = std::max(seen.best, detection.best);
          seen.mean_blur += (detection.q_blur - seen.mean_blur) / ++detections;
        }
      }
    }
    return seen;
  };
  const Seen usual = flown_with({});
  ASSERT_GT(usual.best, 0.0F);
  EXPECT_LT(flown_with({.exposure_factor = 4.0}).best, usual.best);
  EXPECT_LT(flown_with({.vibration_deg_s = 40.0}).mean_blur, usual.mean_blur) << "the best picture may be a lucky one";
  EXPECT_GT(flown_with({.shutter_delay_s = 0.5}).first, usual.first);
}

TEST_F(Windy, ScoresLostToDriftOrWindAreRecordedOnlyWithThatCondition) {
  const auto shown_with = [&](const std::string& odometry, const std::string& wind) {
    scenario_.conditions = {};
    scenario_.conditions.odometry = conditions_preset(odometry).odometry;
    scenario_.conditions.odometry.horizontal_sigma_m *= 4.0;
    scenario_.conditions.wind = conditions_preset(wind).wind;
    Simulation& sim = start(3);
    for (int k = 0; k < 500; ++k) {  // past the wall's points, up and down
      const double z = 10.0 + 8.0 * std::sin(0.02 * k);
      sim.command_trajectory(UavIndex{0}, {.p_WB = {6.0, 0.0, z}, .v_WB = {0, 0, 3.2 * std::cos(0.02 * k)}});
      sim.command_gimbal(UavIndex{0}, {GimbalMode::angle, 0.0, 0.0});
      sim.advance();
    }
    return points_shown(sim);
  };
  const auto count = [](const std::vector<float>& best) {
    return std::ranges::count_if(best, [](float q) { return q > 0.0F; });
  };
  const PointsShown ideal = shown_with("none", "none"), drift = shown_with("harsh", "none"),
                    wind = shown_with("none", "harsh"), both = shown_with("harsh", "harsh");
  EXPECT_GT(std::ranges::count(ideal.seen, true), 5);
  EXPECT_TRUE(ideal.if_exact.empty() && ideal.if_calm.empty());
  EXPECT_GT(count(drift.if_exact), 0);
  EXPECT_TRUE(drift.if_calm.empty());
  EXPECT_TRUE(wind.if_exact.empty());
  EXPECT_GT(count(wind.if_calm), 0);
  EXPECT_GT(count(both.if_exact), 0);
  EXPECT_GT(count(both.if_calm), 0);
}

TEST_F(Windy, DelayedOdometryHasTheTickOfItsState) {
  scenario_.conditions.odometry.latency_s = 0.15;
  start();
  std::vector<RigidBodyState> states;
  hover(4.0, [&] {
    states.push_back(uav().state);
    if (states.size() < 10) return;
    EXPECT_EQ(uav().told_tick, simulation_->tick() - 60);
    EXPECT_EQ(uav().told.p_WB, states[states.size() - 4].p_WB);
  });
}

}  // namespace
}  // namespace skein::sim
