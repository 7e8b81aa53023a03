#include "sim_server/flight/attitude_control.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

constexpr double kTiltGain = 200.0;
constexpr double kIntegralGain = 2.0;
constexpr double kIntegralLimit = 0.6;
/// cos 30 degrees, with the digits of the reference.
constexpr double kC = 0.866025;

double integrated(double sum, double error) { return std::clamp(sum + error, -kIntegralLimit, kIntegralLimit); }

}  // namespace

AttitudeController::AttitudeController(const VehicleConfig& vehicle)
    : gains_(vehicle.attitude_control), inertia_(vehicle.attitude_control.inertia.value_or(vehicle.inertia)) {
  Eigen::Matrix<double, 4, kRotors> allocation;   // rows roll, pitch, yaw, thrust; columns rotors
  allocation << 0.5, 1.0, 0.5, -0.5, -1.0, -0.5,  //
      -kC, 0.0, kC, kC, 0.0, -kC,                 //
      -1.0, 1.0, -1.0, 1.0, -1.0, 1.0,            //
      1.0, 1.0, 1.0, 1.0, 1.0, 1.0;
  const double kf = vehicle.rotor_force_constant;
  const Eigen::Vector4d scale(1.0 / (vehicle.arm_m * kf), 1.0 / (vehicle.arm_m * kf),
                              1.0 / (kf * vehicle.rotor_moment_constant), 1.0 / kf);
  mixer_ = allocation.transpose() * (allocation * allocation.transpose()).inverse() * scale.asDiagonal();
}

RotorSpeeds AttitudeController::step(const Quaterniond& q_WB, const Vector3d& w_WB_B, const ControlDemand& demand) {
  const RollPitchYaw rpy = roll_pitch_yaw(q_WB.normalized().toRotationMatrix());
  const double roll_error = demand.roll - rpy.roll;
  const double pitch_error = demand.pitch - rpy.pitch;
  integrators_.roll = integrated(integrators_.roll, roll_error);
  integrators_.pitch = integrated(integrators_.pitch, pitch_error);
  angular_acceleration_ = {kTiltGain * roll_error - gains_.p_gain * w_WB_B.x() + kIntegralGain * integrators_.roll,
                           kTiltGain * pitch_error - gains_.q_gain * w_WB_B.y() + kIntegralGain * integrators_.pitch,
                           gains_.r_gain * (demand.yaw_rate - w_WB_B.z())};

  const Vector3d torque = inertia_.cwiseProduct(angular_acceleration_) - w_WB_B.cross(inertia_.cwiseProduct(w_WB_B));
  const Eigen::Vector4d wanted(torque.x(), torque.y(), torque.z(), demand.thrust_N);
  const Eigen::Matrix<double, kRotors, 1> squares = mixer_ * wanted;
  RotorSpeeds speeds;
  for (std::size_t i = 0; i < kRotors; ++i) {
    speeds[i] = std::sqrt(std::max(0.0, squares[static_cast<Eigen::Index>(i)]));
  }
  return speeds;
}

}  // namespace skein::sim
