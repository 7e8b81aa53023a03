#include "sim_server/flight/vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <iostream>

#include "core/math/euler.hpp"
#include "sim_server/testing/test_flight.hpp"

namespace skein::sim {
namespace {

using test::Flight;
using test::hover_at;
using test::silent;
using test::vehicle_named;

class VehicleKinds : public testing::TestWithParam<const char*> {
 protected:
  VehicleConfig config_ = vehicle_named(GetParam());
};

TEST_P(VehicleKinds, RotorsFollowWithTheirTimeConstants) {
  Rotors rotors(config_);
  RotorSpeeds demand;
  demand.fill(500.0);
  for (int i = 0; i < 5; ++i) rotors.step(demand);  // 12.5 ms: one time constant upwards
  EXPECT_NEAR(rotors.speeds()[0], 500.0 * (1.0 - std::exp(-1.0)), 1e-9);
  demand.fill(1e6);
  for (int i = 0; i < 400; ++i) rotors.step(demand);
  EXPECT_NEAR(rotors.speeds()[3], config_.rotor_max_speed, 1e-9);
  demand.fill(0.0);
  for (int i = 0; i < 10; ++i) rotors.step(demand);  // 25 ms: one time constant downwards
  EXPECT_NEAR(rotors.speeds()[3], config_.rotor_max_speed * std::exp(-1.0), 1e-9);
}

TEST_P(VehicleKinds, DemandedTorquesAreProduced) {
  // The attitude controller's mixer must match the rotors' positions and directions of rotation.
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      AttitudeController controller(config_);
      ControlDemand demand{.thrust_N = mass_properties(config_).mass_kg * kWorldGravity};
      (axis == 0 ? demand.roll : axis == 1 ? demand.pitch : demand.yaw_rate) = sign * 0.05;
      const RotorSpeeds speeds = controller.step(Quaterniond::Identity(), Vector3d::Zero(), demand);
      Rotors rotors(config_);
      for (int i = 0; i < 400; ++i) rotors.step(speeds);
      const Wrench wrench = rotors.wrench({});
      const Vector3d wanted = config_.attitude_control.inertia->cwiseProduct(controller.angular_acceleration());
      EXPECT_GT(sign * wrench.torque_B[axis], 0.0);
      EXPECT_LT((wrench.torque_B - wanted).norm(), 1e-4 * wanted.norm());
      EXPECT_NEAR(wrench.force_B.z(), demand.thrust_N, 1e-9 * demand.thrust_N);
    }
  }
}

TEST_P(VehicleKinds, DragOpposesMotionAcrossTheRotorsOnly) {
  Rotors rotors(config_);
  RotorSpeeds speeds;
  speeds.fill(500.0);
  for (int i = 0; i < 400; ++i) rotors.step(speeds);
  const Wrench still = rotors.wrench({});
  const Wrench forward = rotors.wrench({.v_WB = {4, 0, 0}});
  EXPECT_NEAR(forward.force_B.x(), -6 * 500.0 * config_.rotor_drag * 4.0, 1e-9);
  EXPECT_NEAR(forward.force_B.y(), 0.0, 1e-9);
  EXPECT_NEAR(rotors.wrench({.v_WB = {0, 0, 4}}).force_B.z(), still.force_B.z(), 1e-9);
}

TEST_P(VehicleKinds, AVehicleRestsUntilTheFirstCommand) {
  Flight flight(config_, rest_height(config_));
  flight.fly(5.0, silent);
  EXPECT_EQ(flight.vehicle().mode(), ControlMode::idle);
  EXPECT_LT((flight.state().p_WB - Vector3d(0, 0, rest_height(config_))).norm(), 1e-3);
}

TEST_P(VehicleKinds, AVehicleTurnsToTheCommandedYaw) {
  Flight flight(config_);
  double fastest = 0.0;
  flight.fly(15.0, hover_at({1, 0, 50}, 2.0), [&] { fastest = std::max(fastest, flight.state().w_WB_B.z()); });
  EXPECT_NEAR(roll_pitch_yaw(flight.state().q_WB.toRotationMatrix()).yaw, 2.0, 0.03);
  EXPECT_LT(fastest, 1.1 * M_PI / 2);
}

TEST_P(VehicleKinds, AVehicleHoldsNearThePlaceWhereACommandLapsed) {
  Flight flight(config_);
  flight.fly(3.0, [](double) { return TrajectoryCommand{.v_WB = {2, 0, 0}}; });
  EXPECT_NEAR(flight.state().v_WB.x(), 2.0, 0.25);
  flight.fly(0.2, silent);
  EXPECT_EQ(flight.vehicle().mode(), ControlMode::hold);
  const double x = flight.state().p_WB.x();
  flight.fly(10.0, silent);
  EXPECT_LT(flight.state().v_WB.norm(), 0.05);
  EXPECT_NEAR(flight.state().p_WB.x(), x, 1.0);
}

TEST_P(VehicleKinds, AFarPositionIsReachedWithinTheLimits) {
  for (const Vector3d& way : {Vector3d(80, 0, 0), Vector3d(-30, 40, 20), Vector3d(0, 0, 45), Vector3d(2, 1, 0)}) {
    Flight flight(config_);
    flight.fly(3.0, hover_at({1, 0, 50}));
    const Vector3d target = Vector3d(1, 0, 50) + way;
    double fastest = 0.0, overshoot = 0.0;
    flight.fly(way.norm() / config_.max_speed_mps + 10.0, hover_at(target), [&] {
      fastest = std::max(fastest, flight.state().v_WB.norm());
      overshoot = std::max(overshoot, (flight.state().p_WB - target).dot(way.normalized()));
    });
    EXPECT_LT(fastest, 1.05 * config_.max_speed_mps) << way.transpose();
    if (way.norm() > 20.0) {
      EXPECT_GT(fastest, 0.8 * config_.max_speed_mps) << way.transpose();
    }
    EXPECT_LT((flight.state().p_WB - target).norm(), 0.15) << way.transpose();
    EXPECT_LT(overshoot, 0.4) << way.transpose();
  }
}

TEST_P(VehicleKinds, AVehicleFollowsAFullTrajectoryClosely) {
  // A circle of 10 m at 4 m/s with all derivatives given, as a good planner flies.
  Flight flight(config_);
  const double radius = 10.0, rate = 0.4;
  flight.fly(5.0, hover_at({radius, 0, 50}));
  const auto circle = [&](double t) -> std::optional<TrajectoryCommand> {
    // Starts slowly: the angle's second derivative is constant for 4 s.
    const double s = t - 5.0, ramp = 4.0, acceleration = rate / ramp;
    const double angle = s < ramp ? 0.5 * acceleration * s * s : 0.5 * rate * ramp + rate * (s - ramp);
    const double w = s < ramp ? acceleration * s : rate, alpha = s < ramp ? acceleration : 0.0;
    const Vector3d out(std::cos(angle), std::sin(angle), 0), along(-std::sin(angle), std::cos(angle), 0);
    return TrajectoryCommand{.p_WB = radius * out + Vector3d(0, 0, 50),
                             .v_WB = radius * w * along,
                             .a_WB = radius * (alpha * along - w * w * out)};
  };
  double worst = 0.0;
  flight.fly(30.0, circle, [&] { worst = std::max(worst, std::abs(flight.state().p_WB.head<2>().norm() - radius)); });
  EXPECT_LT(worst, 0.3);
  EXPECT_NEAR(flight.state().v_WB.norm(), radius * rate, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Both, VehicleKinds, testing::Values("explorer", "photographer"));

/// Prints the CPU time of a tick.
TEST(Vehicle, AVehicleHoldsItsHeightFor100Seconds) {
  PhysicsWorld world({});
  const VehicleConfig config = vehicle_named("explorer");
  std::vector<Vehicle> vehicles;
  for (int i = 0; i < 5; ++i) {
    world.add_uav(config, Isometry3d(Eigen::Translation3d(3.0 * i, 0, 10)));
    vehicles.emplace_back(config, RulesConfig{});
  }
  constexpr int kTicks = 40000;
  const std::clock_t begin = std::clock();
  for (Tick tick = 0; tick < kTicks; ++tick) {
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      const RigidBodyState& state = world.state(UavIndex(i));
      if (tick % kControlTicks == 0) {
        vehicles[i].control(tick, state, TrajectoryCommand{.p_WB = {3.0 * static_cast<double>(i), 1, 10}},
                            std::nullopt);
      }
      const Wrench wrench = vehicles[i].step(state);
      world.apply_wrench(UavIndex(i), state.q_WB * wrench.force_B, state.q_WB * wrench.torque_B);
    }
    world.tick();
  }
  const double time_us = 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::cout << "[ measured ] " << time_us / kTicks << " us of CPU per tick of five UAVs in free flight\n";
  EXPECT_NEAR(world.state(UavIndex{4}).p_WB.z(), 10.0, 0.2);
}

}  // namespace
}  // namespace skein::sim
