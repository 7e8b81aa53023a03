// Compares the flying vehicle with physics: weight, fall, second-order response, limits, motor lag. The expected values
// are computed by hand, not by the code under test.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "core/math/euler.hpp"
#include "core/vehicle/airframe.hpp"
#include "sim_server/testing/test_flight.hpp"

namespace skein::sim {
namespace {

using test::Flight;
using test::hover_at;
using test::no_limits;
using test::vehicle_named;

class Dynamics : public testing::TestWithParam<const char*> {
 protected:
  VehicleConfig config_ = vehicle_named(GetParam());
  double mass() const { return mass_properties(config_).mass_kg; }
  double weight() const { return mass() * kWorldGravity; }
};

TEST_P(Dynamics, HoverThrustEqualsWeight) {
  Flight flight(config_);
  flight.fly(30.0, hover_at({1, 2, 50.5}));
  double sum = 0.0, count = 0.0, fastest = 0.0;
  flight.fly(5.0, hover_at({1, 2, 50.5}), [&] {
    sum += flight.thrust();
    ++count;
    fastest = std::max(fastest, flight.state().v_WB.norm());
  });
  EXPECT_NEAR(sum / count, weight(), 1e-3 * weight());
  EXPECT_LT(fastest, 0.005);
  EXPECT_LT((flight.state().p_WB - Vector3d(1, 2, 50.5)).norm(), 0.02);
}

TEST_P(Dynamics, AUavFallsFreelyAfterStop) {
  // The rotors run down exponentially, from a thrust that carried the weight; a level fall has no drag in this model.
  Flight flight(config_, 300.0);
  flight.fly(30.0, hover_at({1, 0, 300}));
  const double tau = config_.motor_time_constant_down_s, g = kWorldGravity;
  const double z0 = flight.state().p_WB.z(), v0 = flight.state().v_WB.z(), t0 = flight.time_s();
  flight.vehicle().stop();
  for (const double t : {0.05, 0.5, 1.0, 3.0}) {
    flight.fly(t0 + t - flight.time_s(), hover_at({1, 0, 300}));
    const double gone = 1.0 - std::exp(-2.0 * t / tau);  // of the thrust
    const double v = v0 - g * (t - 0.5 * tau * gone);
    const double z = z0 + v0 * t - g * (0.5 * t * t - 0.5 * tau * t + 0.25 * tau * tau * gone);
    EXPECT_NEAR(flight.state().v_WB.z(), v, 0.03) << t;
    EXPECT_NEAR(flight.state().p_WB.z(), z, 0.5 * g * t * kTickS + 0.03 * t) << t;
  }
  EXPECT_LT(flight.thrust(), 1e-6);
}

TEST_P(Dynamics, RotorsThatRunDownBrakeAcrossTheirAxes) {
  // Six drags, each as rotor speed times velocity: the velocity decays by the integral of the rotor speeds. Without
  // weight and with the drag at the centre of mass nothing else happens.
  VehicleConfig config = config_;
  config.rotor_height_m = config.rolling_moment = 0.0;
  config.links.clear();
  config.mass_kg = mass();
  config.rotor_mass_kg = 0.0;
  const double tau = config.motor_time_constant_down_s, start = 500.0;
  PhysicsWorld world({});
  world.add_uav(config, Isometry3d(Eigen::Translation3d(0, 0, 100)));
  world.set_state(UavIndex{0}, {.p_WB = {0, 0, 100}, .v_WB = {5, 2, 0}});
  Rotors rotors(config);
  RotorSpeeds demand;
  demand.fill(start);
  for (int i = 0; i < 400; ++i) rotors.step(demand);
  for (Tick tick = 1; tick <= 100; ++tick) {
    rotors.step({});
    const RigidBodyState& state = world.state(UavIndex{0});
    world.apply_wrench(UavIndex{0}, state.q_WB * rotors.wrench(state).force_B, Vector3d::Zero());
    world.tick();
    const double t = seconds(tick);
    const double turned = start * tau * (1.0 - std::exp(-t / tau));
    const double share = std::exp(-6.0 * config.rotor_drag * turned / config.mass_kg);
    EXPECT_NEAR(world.state(UavIndex{0}).v_WB.x(), 5.0 * share, 2e-3) << t;
    EXPECT_NEAR(world.state(UavIndex{0}).v_WB.y(), 2.0 * share, 2e-3) << t;
  }
}

/// Step response of x'' = w^2 (1 - x) - 2 z w x', from rest at 0.
double second_order(double w, double z, double t) {
  if (std::abs(z - 1.0) < 1e-9) return 1.0 - (1.0 + w * t) * std::exp(-w * t);
  if (z < 1.0) {
    const double d = w * std::sqrt(1.0 - z * z);
    return 1.0 - std::exp(-z * w * t) * (std::cos(d * t) + z * w / d * std::sin(d * t));
  }
  const double root = std::sqrt(z * z - 1.0), fast = -w * (z + root), slow = -w * (z - root);
  return 1.0 + (slow * std::exp(fast * t) - fast * std::exp(slow * t)) / (fast - slow);
}

TEST_P(Dynamics, AStepSettlesAsFrequencyAndDampingSay) {
  // Without the law's integral term, which frequency and damping do not include. Motors, tilt and the law's 20 Hz are
  // not in the formula either: they change the response by up to a tenth of the step.
  config_.position_control.ki_xy = config_.position_control.ki_z = 0.0;
  const PositionControlConfig& law = config_.position_control;
  // The vertical thrust depends on the mass that the control law assumes.
  const double pull = std::sqrt(0.19 * law.thrust_scale / 9.781 / mass());
  struct Axis {
    Vector3d direction;
    double omega, zeta;
  };
  for (const Axis& axis :
       {Axis{Vector3d::UnitX(), law.omega_xy, law.zeta_xy}, Axis{-Vector3d::UnitY(), law.omega_xy, law.zeta_xy},
        Axis{Vector3d::UnitZ(), law.omega_z * pull, law.zeta_z * pull}}) {
    const double step = 0.3;
    Flight flight(config_, 50.0, no_limits());
    flight.fly(20.0, hover_at({1, 0, 50}));
    const Vector3d from = flight.state().p_WB;
    std::vector<double> moved;
    flight.fly(6.0, hover_at(Vector3d(1, 0, 50) + step * axis.direction),
               [&] { moved.push_back((flight.state().p_WB - from).dot(axis.direction) / step); });
    const auto greatest_gap = [&](double omega) {
      double gap = 0.0;
      for (std::size_t i = 0; i < moved.size(); ++i) {
        gap = std::max(gap, std::abs(moved[i] - second_order(omega, axis.zeta, seconds(static_cast<Tick>(i + 1)))));
      }
      return gap;
    };
    std::cout << "[ measured ] " << GetParam() << ", along " << axis.direction.transpose() << ": within "
              << 100.0 * greatest_gap(axis.omega) << " % of the step\n";
    EXPECT_LT(greatest_gap(axis.omega), 0.1);
    EXPECT_GT(greatest_gap(1.5 * axis.omega), 0.12) << "another frequency would fit as well";
    EXPECT_GT(greatest_gap(axis.omega / 1.5), 0.12) << "another frequency would fit as well";
    EXPECT_LT(*std::max_element(moved.begin(), moved.end()), 1.06) << "damped: hardly any overshoot";
    EXPECT_NEAR(moved.back(), 1.0, 0.005);
  }
}

TEST_P(Dynamics, TiltAndThrustStayWithinTheirLimits) {
  const double max_tilt = config_.position_control.max_tilt_deg * kRadPerDeg;
  const double max_thrust = 6.0 * config_.rotor_force_constant * config_.rotor_max_speed * config_.rotor_max_speed;
  double steepest = 0.0, steepest_settled = 0.0, strongest = 0.0, fastest_rotor = 0.0, lowest_demand = 1e9;
  for (const Vector3d& far : {Vector3d(900, 0, 500), Vector3d(-500, 700, -500), Vector3d(0, -900, 1500),
                              Vector3d(800, 800, -900), Vector3d(0, 0, 1e4)}) {
    Flight flight(config_, 500.0, no_limits());
    flight.fly(2.0, hover_at({0.5, 0, 500}));
    Tick tick = 0;
    flight.fly(3.0, hover_at(far), [&] {
      const RollPitchYaw rpy = roll_pitch_yaw(flight.state().q_WB.toRotationMatrix());
      const double tilt = std::max(std::abs(rpy.roll), std::abs(rpy.pitch));
      steepest = std::max(steepest, tilt);
      if (2 * ++tick > 3 * kTicksPerSecond) steepest_settled = std::max(steepest_settled, tilt);
      strongest = std::max(strongest, flight.wrench().force_B.z());
      for (const double speed : flight.vehicle().rotor_speeds()) fastest_rotor = std::max(fastest_rotor, speed);
      EXPECT_LE(std::abs(flight.vehicle().demand().roll), max_tilt);
      EXPECT_LE(std::abs(flight.vehicle().demand().pitch), max_tilt);
      lowest_demand = std::min(lowest_demand, flight.vehicle().target_acceleration().z());
    });
  }
  std::cout << "[ measured ] " << GetParam() << ": tilt " << steepest_settled / max_tilt << " of the limit, at first "
            << steepest / max_tilt << "; thrust up to " << strongest / weight() << " of the weight\n";
  EXPECT_GT(steepest_settled, 0.95 * max_tilt) << "else the commands are not extreme";
  EXPECT_LT(steepest_settled, 1.03 * max_tilt);
  EXPECT_LT(steepest, 1.2 * max_tilt) << "the attitude loop overshoots its demand, but not by more";
  EXPECT_LE(fastest_rotor, config_.rotor_max_speed);
  EXPECT_LE(strongest, max_thrust);
  EXPECT_GT(strongest, 1.5 * weight());
  EXPECT_GE(lowest_demand, 0.3 * 9.781 - 1e-9) << "it never dives upside down";
}

TEST_P(Dynamics, AUavTurnsNoFasterThanItsVehicleMay) {
  for (const double limit_deg : {20.0, 45.0, 90.0}) {
    config_.max_yaw_rate_deg_s = limit_deg;
    Flight flight(config_);
    double fastest = 0.0;
    flight.fly(3.0, hover_at({1, 0, 50}));
    flight.fly(15.0, hover_at({1, 0, 50}, 3.0), [&] { fastest = std::max(fastest, flight.state().w_WB_B.z()); });
    EXPECT_LT(fastest, 1.02 * limit_deg * kRadPerDeg) << limit_deg;
    EXPECT_GT(fastest, 0.95 * limit_deg * kRadPerDeg) << limit_deg;
    EXPECT_NEAR(roll_pitch_yaw(flight.state().q_WB.toRotationMatrix()).yaw, 3.0, 0.05);
  }
  Flight unguarded(config_, 50.0, no_limits());
  config_.max_yaw_rate_deg_s = 20.0;
  double fastest = 0.0;
  unguarded.fly(5.0, hover_at({1, 0, 50}, 3.0), [&] { fastest = std::max(fastest, unguarded.state().w_WB_B.z()); });
  EXPECT_GT(fastest, 80.0 * kRadPerDeg) << "the reference has only its own limit";
}

TEST_P(Dynamics, MotorsLagInSpeedingUpAndInSlowingDown) {
  // Time constants as a bench would measure them: from the thrust after a step, not from the code.
  constexpr double kFine = 1e-5;
  const auto time_to = [&](double from, double to, double share) {
    Rotors rotors(config_, kFine);
    RotorSpeeds demand;
    demand.fill(from);
    for (int i = 0; i < 100000; ++i) rotors.step(demand);
    demand.fill(to);
    const double goal = from + share * (to - from);
    int steps = 0;
    while ((rotors.speeds()[0] - goal) * (to - from) < 0.0) {
      rotors.step(demand);
      ++steps;
    }
    return steps * kFine;
  };
  const double one = 1.0 - std::exp(-1.0), two = 1.0 - std::exp(-2.0);
  EXPECT_NEAR(time_to(300, 600, one), config_.motor_time_constant_up_s, 2e-5);
  EXPECT_NEAR(time_to(300, 600, two), 2.0 * config_.motor_time_constant_up_s, 3e-5);
  EXPECT_NEAR(time_to(600, 300, one), config_.motor_time_constant_down_s, 2e-5);
  EXPECT_NEAR(time_to(600, 300, two), 2.0 * config_.motor_time_constant_down_s, 3e-5);
  // In flight, at the step of the physics: with the motors cut the acceleration approaches g as the thrust fades.
  Flight flight(config_, 100.0);
  flight.fly(30.0, hover_at({1, 0, 100}));
  flight.vehicle().stop();
  Tick tick = 0;
  flight.fly(0.1, test::silent, [&] {
    const double a = (flight.state().v_WB.z() - flight.before().v_WB.z()) / kTickS;
    const double thrust = std::exp(-2.0 * seconds(++tick) / config_.motor_time_constant_down_s);
    EXPECT_NEAR(a, -kWorldGravity * (1.0 - thrust), 0.02) << tick;
  });
}

TEST_P(Dynamics, HalvingTheStepOfThePhysicsChangesLittle) {
  // 60 s of turns, climbs and stops, controllers at their own rates. The integration is of first order: half the step,
  // half the difference.
  const auto pilot = [](double t) -> std::optional<TrajectoryCommand> {
    if (t < 4.0) return TrajectoryCommand{.p_WB = {8, 0, 50}};
    const double w = 0.35, s = w * (t - 4.0), ramp = std::min(1.0, 0.2 * (t - 4.0));
    if (t > 50.0) return TrajectoryCommand{.p_WB = {-6, 5, 47}, .yaw = -2.0};
    return TrajectoryCommand{
        .p_WB = {8 * std::cos(s), 8 * std::sin(s), 50 + 3 * std::sin(2.0 * s)},
        .v_WB = ramp * Vector3d(-8 * w * std::sin(s), 8 * w * std::cos(s), 6 * w * std::cos(2.0 * s)),
        .yaw = std::sin(0.5 * t)};
  };
  std::array<std::vector<Vector3d>, 3> paths;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    Flight flight(config_, 50.0, {}, 1 << i);
    int steps = 0;
    flight.fly(60.0, pilot, [&] {
      if (++steps % (1 << i) == 0) paths[i].push_back(flight.state().p_WB);
    });
  }
  const auto greatest_gap = [&](std::size_t a, std::size_t b) {
    double gap = 0.0;
    for (std::size_t i = 0; i < paths[a].size(); ++i) gap = std::max(gap, (paths[a][i] - paths[b][i]).norm());
    return gap;
  };
  ASSERT_EQ(paths[0].size(), paths[1].size());
  const double half = greatest_gap(0, 1), quarter = greatest_gap(1, 2);
  std::cout << "[ measured ] " << GetParam() << ": " << 1e3 * half << " mm from 2.5 to 1.25 ms, " << 1e3 * quarter
            << " mm from there to 0.625 ms\n";
  EXPECT_LT(half, 0.03);
  EXPECT_LT(quarter, 0.7 * half);
}

INSTANTIATE_TEST_SUITE_P(Both, Dynamics, testing::Values("explorer", "photographer"));

TEST(DynamicsOfTheFleet, AnExplorerIsSlowerThanAPhotographer) {
  const std::vector<Vector3d> course = {{40, 0, 50}, {40, 30, 50}, {0, 30, 65}, {0, 0, 50}};
  const auto lap = [&](const VehicleConfig& config) {
    Flight flight(config);
    flight.fly(5.0, hover_at({0.5, 0, 50}));
    const double begun = flight.time_s();
    for (const Vector3d& corner : course) {
      const Vector3d corner_W = corner + Vector3d(0.5, 0, 0);
      while ((flight.state().p_WB - corner_W).norm() > 0.3 && flight.time_s() < begun + 200.0) {
        flight.fly(0.05, hover_at(corner_W));
      }
    }
    return flight.time_s() - begun;
  };
  // A point mass that stops at every corner: length by speed, and a speed by acceleration for every leg.
  const auto least = [&](const VehicleConfig& config) {
    double t = 0.0;
    Vector3d from(0, 0, 50);
    for (const Vector3d& corner : course) {
      t += (corner - from).norm() / config.max_speed_mps + config.max_speed_mps / config.max_acceleration_mps2;
      from = corner;
    }
    return t;
  };
  const VehicleConfig explorer = vehicle_named("explorer"), photographer = vehicle_named("photographer");
  const double slow = lap(explorer), fast = lap(photographer);
  std::cout << "[ measured ] explorer " << slow << " s, photographer " << fast << " s; point masses " << least(explorer)
            << " s, " << least(photographer) << " s\n";
  EXPECT_GT(slow, 1.1 * fast);
  EXPECT_GT(slow, 0.97 * least(explorer));
  EXPECT_GT(fast, 0.97 * least(photographer));
  EXPECT_LT(slow, 1.6 * least(explorer));
  EXPECT_LT(fast, 1.6 * least(photographer));
}

}  // namespace
}  // namespace skein::sim
