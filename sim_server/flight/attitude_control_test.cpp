// Properties of the mixer; the controller's numbers are checked by sim_server/golden/check_test.cpp.
#include "sim_server/flight/attitude_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein::sim {
namespace {

/// Thrust and torque that six rotors at these speeds make on a hexarotor.
Eigen::Vector4d wrench(const VehicleConfig& vehicle, const RotorSpeeds& speeds) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < kRotors; ++i) {
    const double thrust = vehicle.rotor_force_constant * speeds[i] * speeds[i];
    const double angle = (30.0 + 60.0 * static_cast<double>(i)) * std::numbers::pi / 180.0;
    const Vector3d arm = vehicle.arm_m * Vector3d(std::cos(angle), std::sin(angle), 0);
    const Vector3d tilt = arm.cross(thrust * Vector3d::UnitZ());
    const double turn = (i % 2 == 0 ? -1.0 : 1.0) * vehicle.rotor_moment_constant * thrust;
    sum += Eigen::Vector4d(tilt.x(), tilt.y(), turn, thrust);
  }
  return sum;
}

TEST(AttitudeController, RotorsGiveTheTorqueAndThrustAskedFor) {
  const VehicleConfig vehicle;
  for (int i = 0; i < 100; ++i) {
    AttitudeController controller(vehicle);
    const Vector3d w(0.1 * std::sin(i), 0.1 * std::cos(2.0 * i), 0.05 * std::sin(3.0 * i));
    const ControlDemand demand{0.02 * std::sin(5.0 * i), 0.02 * std::cos(7.0 * i), 0.05 * std::sin(i), 33.0};
    const RotorSpeeds speeds = controller.step(Quaterniond::Identity(), w, demand);
    const Vector3d torque =
        vehicle.inertia.cwiseProduct(controller.angular_acceleration()) - w.cross(vehicle.inertia.cwiseProduct(w));
    const Eigen::Vector4d made = wrench(vehicle, speeds);
    EXPECT_NEAR(made[0], torque.x(), 1e-4);  // the mixer's cos 30 degrees has six digits
    EXPECT_NEAR(made[1], torque.y(), 1e-4);
    EXPECT_NEAR(made[2], torque.z(), 1e-4);
    EXPECT_NEAR(made[3], 33.0, 1e-4);
  }
}

TEST(AttitudeController, WithoutADemandNoRotorTurns) {
  AttitudeController controller{VehicleConfig{}};
  for (const double speed : controller.step(Quaterniond::Identity(), Vector3d::Zero(), {})) EXPECT_EQ(speed, 0.0);
}

TEST(AttitudeController, IntegratorsAreBounded) {
  AttitudeController controller{VehicleConfig{}};
  for (int i = 0; i < 100; ++i) {
    controller.step(Quaterniond::Identity(), Vector3d::Zero(), {0.3, -0.3, 0.0, 30.0});
  }
  EXPECT_EQ(controller.integrators().roll, 0.6);
  EXPECT_EQ(controller.integrators().pitch, -0.6);
}

}  // namespace
}  // namespace skein::sim
