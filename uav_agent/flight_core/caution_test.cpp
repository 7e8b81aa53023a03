#include "uav_agent/flight_core/caution.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/random_stream.hpp"
#include "uav_agent/flight_core/flight_core.hpp"
#include "uav_agent/testing/flown_uav.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

AgentConfig with_battery() {
  AgentConfig agent;
  agent.fleet = {{.name = "a"}};
  agent.battery.endurance_missions = 0.5;
  agent.duration_s = 400.0;
  return agent;
}

/// A UAV at a place; the test sets its inputs.
struct Told : FlownUav {
  explicit Told(const FlightConfig& flight = {})
      : FlownUav(with_battery(), {0.0, 0.0, 20.0}), flight_config(flight), caution(flight_config, agent) {}
  PlannerInput told() const {
    PlannerInput in = input();
    in.uncertainty = uncertainty;
    in.battery = battery;
    in.wind_W = wind_W;
    return in;
  }
  FlightConfig flight_config;
  PoseUncertainty uncertainty;
  std::optional<BatteryStatus> battery;
  std::optional<Vector3d> wind_W;
  Caution caution;
};

TEST(Caution, ChangesNothingWithoutUncertaintyWindAndBattery) {
  Told uav;
  uav.caution.update(uav.told());
  EXPECT_EQ(uav.caution.errors().seen_m, 0.0);
  EXPECT_EQ(uav.caution.errors().told_m, 0.0);
  EXPECT_TRUE(uav.caution.errors().peers_m.empty());
  EXPECT_EQ(uav.caution.most_mps(), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(uav.caution.must_land(uav.told()));
}

/// To the next step of 5 cm.
double rounded_up_m(double error_m) { return 0.05 * std::ceil(error_m / 0.05 - 1e-9); }

TEST(Caution, ClearanceGrowsWithCovarianceAndWindUpToABound) {
  Told uav;
  const double sigmas = uav.flight_config.drift_sigmas, pushed_m = uav.flight_config.wind_error_s * 8.0;
  uav.uncertainty.position_m = {0.1, 0.1, 0.2};
  const double any_way_m = std::sqrt(0.06 / 3.0);
  uav.caution.update(uav.told());
  EXPECT_NEAR(uav.caution.errors().seen_m, rounded_up_m(sigmas * any_way_m), 1e-12)
      << "without conditions, the whole deviation may be drift";
  EXPECT_NEAR(uav.caution.errors().told_m, rounded_up_m(sigmas * any_way_m * std::sqrt(2.0)), 1e-12)
      << "the UAV and the sender of the map both err";
  EXPECT_NEAR(uav.caution.errors().ground_m, rounded_up_m(sigmas * 0.2 * std::sqrt(2.0)), 1e-12)
      << "the ground was seen with an error, too";
  uav.wind_W = Vector3d(0, 8, 0);
  uav.caution.update(uav.told());
  EXPECT_NEAR(uav.caution.errors().seen_m, rounded_up_m(sigmas * any_way_m + pushed_m), 1e-12);
  uav.uncertainty.position_m = {5, 5, 5};
  uav.caution.update(uav.told());
  for (const double error_m : {uav.caution.errors().seen_m, uav.caution.errors().told_m}) EXPECT_EQ(error_m, 1.0);
}

// Independent errors add as squares. The wind pushes both UAVs, so it counts once.
TEST(Caution, KeepsOffAnotherUavByBothErrorsAlongEachAxis) {
  for (int seed = 0; seed < 20; ++seed) {
    RandomStream draw(static_cast<std::uint64_t>(seed), "caution_peers", 0);
    AgentConfig agent = with_battery();
    agent.fleet.push_back({.name = "b", .p_WB_start = {2.0, 0.0, 0.1}});
    // Up to and beyond the bound of 2 m.
    agent.odometry.horizontal_sigma_m = draw.uniform(0.05, seed % 2 == 0 ? 0.4 : 1.2);
    agent.odometry.vertical_sigma_m = draw.uniform(0.05, seed % 2 == 0 ? 0.4 : 1.2);
    agent.odometry.bias_sigma_m = draw.uniform(0.0, 0.2);
    agent.odometry.known_start = true;
    FlownUav uav(agent, {0.0, 0.0, 20.0});
    const FlightConfig config;
    Caution caution(config, uav.agent);
    const double wind_mps = draw.uniform(0.0, 10.0);
    const auto errors_m = [&](Tick tick, const Vector3d& p_W, const Vector3d& v_W) {
      uav.peers.update(tick, {{.node = Node{2}, .p_W = p_W, .v_W = v_W}});
      PlannerInput in = uav.input();
      in.uncertainty.position_m = deviation_in_flight_m(agent.odometry);
      in.wind_W = Vector3d(wind_mps, 0.0, 0.0);
      caution.update(in);
      return caution.errors().peers_m.at(1);
    };
    const auto expected_m = [&](double sigma_m, double grown) {
      const double own2 = sigma_m * sigma_m, bias2 = std::pow(agent.odometry.bias_sigma_m, 2);
      const double both_m = std::sqrt(own2 + bias2 + grown * own2 + bias2);
      return std::min(2.0, rounded_up_m(config.drift_sigmas * both_m + config.wind_error_s * wind_mps));
    };
    const Vector3d start_W(2.0, 0.0, 0.1), still_W = Vector3d::Zero();
    const double across_m = agent.odometry.horizontal_sigma_m, up_m = agent.odometry.vertical_sigma_m;
    const Vector3d stands_m = errors_m(ticks(5.0), start_W, still_W);
    EXPECT_NEAR(stands_m.x(), expected_m(across_m, 0.0), 1e-9) << seed << ": it knows where it stands";
    EXPECT_NEAR(stands_m.z(), expected_m(up_m, 0.0), 1e-9) << seed;
    const double for_s = draw.uniform(1.0, 200.0);
    const Vector3d flies_m = errors_m(ticks(5.0) + ticks(for_s), start_W + Vector3d(0, 0, 8), still_W);
    const double grown = 1.0 - std::exp(-2.0 * seconds(ticks(for_s)) / agent.odometry.time_constant_s);
    EXPECT_NEAR(flies_m.x(), expected_m(across_m, grown), 1e-9) << seed;
    EXPECT_NEAR(flies_m.z(), expected_m(up_m, grown), 1e-9) << seed;
    // Back at its start, it still errs as it did in the air.
    const Vector3d landed_m = errors_m(ticks(5.0) + 2 * ticks(for_s), start_W, still_W);
    EXPECT_GE(landed_m.x(), flies_m.x() - 1e-9) << seed;
  }
}

// The test draws errors of odometry and measures how far the position drifts within look_s, the time in which a LiDAR
// sees everything again. The UAV must keep off structure by this drift.
TEST(Caution, AllowsForTheDriftSinceStructureWasSeen) {
  for (int seed = 0; seed < 12; ++seed) {
    RandomStream draw(static_cast<std::uint64_t>(seed), "caution_test", 1);
    Told uav;
    OdometryConditions& odometry = uav.agent.odometry;
    odometry.horizontal_sigma_m = odometry.vertical_sigma_m = draw.uniform(0.05, 0.2);
    odometry.time_constant_s = draw.uniform(10.0, 200.0);
    odometry.bias_sigma_m = draw.uniform(0.0, 0.2);
    odometry.noise_sigma_m = draw.uniform(0.0, 0.02);
    const double sigma_m = odometry.horizontal_sigma_m;
    const double keeps = std::exp(-uav.flight_config.look_s / odometry.time_constant_s);
    double squares = 0.0;
    constexpr int kTimes = 20000;
    for (int i = 0; i < kTimes; ++i) {
      const double before_m = sigma_m * draw.normal(), bias_m = odometry.bias_sigma_m * draw.normal();
      const double now_m = keeps * before_m + sigma_m * std::sqrt(1.0 - keeps * keeps) * draw.normal();
      const double noise_m = odometry.noise_sigma_m * (draw.normal() - draw.normal());
      squares += std::pow(now_m + bias_m - before_m - bias_m + noise_m, 2);
    }
    uav.uncertainty.position_m.setConstant(
        std::sqrt(std::pow(sigma_m, 2) + std::pow(odometry.bias_sigma_m, 2) + std::pow(odometry.noise_sigma_m, 2)));
    uav.caution.update(uav.told());
    const double drift_m = uav.flight_config.drift_sigmas * std::sqrt(squares / kTimes);
    EXPECT_GE(uav.caution.errors().seen_m, rounded_up_m(0.97 * drift_m) - 1e-12) << seed;
    EXPECT_LE(uav.caution.errors().seen_m, rounded_up_m(1.03 * drift_m) + 1e-12) << seed;
    EXPECT_LT(uav.caution.errors().seen_m, uav.caution.errors().told_m) << seed;
  }
}

TEST(Caution, AllowsForALostFixAndForAWhileAfterIt) {
  Told uav;
  OdometryConditions& odometry = uav.agent.odometry;
  odometry.horizontal_sigma_m = odometry.vertical_sigma_m = 0.1;
  const auto seen_m = [&](double told_m, double for_s) {
    uav.uncertainty.position_m.setConstant(told_m);
    for (double t = 0.0; t < for_s; t += uav.agent.exchange_period_s) uav.caution.update(uav.told());
    return uav.caution.errors().seen_m;
  };
  const double usual_m = seen_m(0.1, 1.0), lost_m = seen_m(0.4, 1.0);
  EXPECT_GT(lost_m, uav.flight_config.drift_sigmas * std::sqrt(0.4 * 0.4 - 0.1 * 0.1));
  EXPECT_GT(seen_m(0.1, 0.05), 0.95 * lost_m) << "its map was made in the time without a fix";
  EXPECT_NEAR(seen_m(0.1, 20.0 * uav.flight_config.look_s), usual_m, 1e-3);
}

TEST(Caution, FliesSlowerInGustsAndNotInASteadyWind) {
  for (const double gusts_mps : {0.0, 2.0, 4.0}) {
    Told uav;
    RandomStream draw(1, "caution_test", 0);
    for (int i = 0; i < 4000; ++i) {
      uav.wind_W = Vector3d(9.0 + gusts_mps * draw.normal(), 0, 0);
      uav.caution.update(uav.told());
    }
    if (gusts_mps == 0.0) {
      EXPECT_GE(uav.caution.most_mps(), uav.flight_config.approach_mps);
    } else {
      EXPECT_NEAR(uav.caution.most_mps() / uav.flight_config.approach_mps,
                  std::max(0.5, 1.0 - uav.flight_config.gust_slows_s_m * (gusts_mps - 1.0)), 0.06);
    }
  }
}

TEST(Caution, DecidesToLandByChargeDistanceAndWind) {
  // Half the charge is gone in 100 s of 0.5 missions of 400 s: a second costs 0.005.
  const auto lands_at = [](const Vector3d& p_WB, const std::optional<Vector3d>& wind_W) {
    Told uav;
    uav.state.p_WB = p_WB;
    uav.wind_W = wind_W;
    double charge = 1.0;
    for (; charge > 0.0; charge -= 0.005 * 0.05) {
      uav.battery = BatteryStatus{.charge = charge};
      uav.caution.update(uav.told());
      if (uav.caution.must_land(uav.told())) break;
      ++uav.k;
    }
    return charge;
  };
  const double reserve = with_battery().battery.reserve;
  const double near = lands_at({0, 0, 10}, {}), far = lands_at({60, 0, 10}, {}), high = lands_at({0, 0, 40}, {});
  EXPECT_GT(near, reserve);
  EXPECT_GT(far, near + 0.005 * 60.0 / 6.0) << "60 m take 10 s at least";
  EXPECT_NEAR(high - near, 0.005 * 30.0 / 3.0, 0.005) << "30 m more at climb_mps";
  EXPECT_LT(lands_at({60, 0, 40}, {}), far + 0.005 * 10.0) << "it loses the height on the way";
  EXPECT_GT(lands_at({60, 0, 10}, Vector3d(10, 0, 0)), far) << "against the wind";
  EXPECT_NEAR(lands_at({60, 0, 10}, Vector3d(-10, 0, 0)), far, 1e-3) << "a tail wind is not counted on";
}

TEST(Caution, ARestartOrAPauseIsNoReasonToGoHome) {
  Told uav;
  uav.battery = BatteryStatus{.charge = 0.6};  // the first that a restarted program hears
  uav.caution.update(uav.told());
  EXPECT_FALSE(uav.caution.must_land(uav.told()));
  uav.k += 400;  // 20 s at 0.005 a second
  uav.battery->charge = 0.5;
  uav.caution.update(uav.told());
  EXPECT_FALSE(uav.caution.must_land(uav.told()));
}

TEST(Caution, ASuddenLossOfChargeIsNotTakenForConsumption) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "loss", 0);
    Told uav;
    double charge = random.uniform(0.85, 1.0);
    const auto fly = [&](double time_s) {
      for (int i = 0; i < time_s * 20.0; ++i, ++uav.k) {
        uav.battery = BatteryStatus{.charge = charge -= 0.005 * 0.05};
        uav.caution.update(uav.told());
        EXPECT_FALSE(uav.caution.must_land(uav.told())) << "seed " << seed << " charge " << charge;
        EXPECT_FALSE(uav.caution.must_sink(uav.told())) << "seed " << seed;
      }
    };
    fly(20.0);
    charge = random.uniform(0.55, 0.65);
    fly(30.0);
    EXPECT_FALSE(uav.caution.has_full_battery(uav.told()));
  }
}

// The UAV's program may have been down while the battery was swapped.
TEST(Caution, ASwappedBatteryCountsAsFullUntilTheUavMustLandAgain) {
  Told uav;
  const auto told = [&](double charge) {
    uav.battery = BatteryStatus{.charge = charge};
    uav.caution.update(uav.told());
    ++uav.k;
    return uav.caution.has_full_battery(uav.told());
  };
  EXPECT_FALSE(told(0.25));
  EXPECT_TRUE(told(0.8));
  EXPECT_TRUE(told(0.79));
  EXPECT_FALSE(told(0.05));
  EXPECT_FALSE(told(0.05));
}

TEST(Caution, CanBeTurnedOff) {
  Told uav(FlightConfig{.reacts = false});
  uav.uncertainty.position_m = {1, 1, 1};
  uav.wind_W = Vector3d(9, 0, 0);
  uav.battery = BatteryStatus{.charge = 0.01};
  uav.caution.update(uav.told());
  EXPECT_EQ(uav.caution.errors().seen_m, 0.0);
  EXPECT_EQ(uav.caution.errors().told_m, 0.0);
  EXPECT_TRUE(uav.caution.errors().peers_m.empty());
  EXPECT_FALSE(uav.caution.must_land(uav.told()));
  EXPECT_FALSE(uav.caution.must_sink(uav.told()));
}

// The flight home needs more charge than the descent from here. So the UAV must fly home to land first, and must sink
// where it is only much later.
TEST(Caution, MustSinkOnlyWhenTheDescentFromHereNeedsAllThatIsLeft) {
  for (const double height_m : {2.0, 20.0, 60.0}) {
    Told uav;
    uav.agent.battery.endurance_missions = 1.0;
    uav.agent.duration_s = 200.0;  // at hover, half a percent of the charge a second
    const Caution caution(uav.flight_config, uav.agent);
    uav.state.p_WB = {60.0, 0.0, height_m};
    const double descent_s = Landing::descent_s(height_m, uav.flight_config);
    for (double charge = 1.0; charge > 0.0; charge -= 0.005) {
      uav.battery = BatteryStatus{.charge = charge};
      const bool sinks = caution.must_sink(uav.told());
      EXPECT_TRUE(sinks || charge >= 0.005 * descent_s) << height_m << " " << charge;
      EXPECT_FALSE(sinks && charge > 0.005 * (1.5 * descent_s + 20.0)) << height_m << " " << charge;
      EXPECT_TRUE(!sinks || caution.must_land(uav.told())) << height_m << " " << charge;
    }
  }
}

// The core's reaction to a low battery, until the UAV rests.
TEST(FlightCore, AUavWithALowBatteryFliesToItsStartAndLands) {
  Told uav;
  uav.clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 24.0});
  uav.boxes = {make_box({0.0, 15.0, 9.0}, {6.0, 6.0, 8.0})};
  FlightCore core(uav.flight_config, uav.agent);
  uav.state.p_WB = {12.0, -9.0, 12.0};
  double charge = 0.5, landed_with = 0.0;
  bool landing = false;
  for (int i = 0; i < 2400; ++i, charge -= 0.005 * 0.05) {
    uav.battery = BatteryStatus{.charge = charge};
    PlannerInput in = uav.told();
    core.update(in);
    const Steering steering = core.step(in, std::vector<Goal>{{.id = 1, .way = {{Vector3d(14.0, 5.0, 14.0), 3.0}}}});
    landing = landing || core.doing(in).what == Doing::What::lands;
    if (const auto* path = std::get_if<Path>(&steering.motion)) uav.tracker.follow(*path);
    if (std::holds_alternative<Hold>(steering.motion)) uav.tracker.hold();
    core.move(uav.tracker,
              {.tick = in.tick, .state = uav.state, .map = uav.map, .boxes = uav.boxes, .peers = uav.peers});
    uav.state.p_WB = uav.tracker.commanded().p_WB;
    uav.state.v_WB = uav.tracker.commanded().v_WB;
    if (landing && uav.state.p_WB.z() < 0.2) landed_with = std::max(landed_with, charge);
    ++uav.k;
  }
  EXPECT_TRUE(landing);
  EXPECT_GT(landed_with, uav.agent.battery.reserve - 0.01);
  EXPECT_LT(landed_with, uav.agent.battery.reserve + 0.1) << "it could have worked for longer";
  EXPECT_LT(uav.state.p_WB.head<2>().norm(), 1.0) << "at its start";
  EXPECT_LT(uav.state.p_WB.z(), 0.0) << "its setpoint is below the ground: it stands firm";
}

}  // namespace
}  // namespace skein::agent
