// Types that all parts of Skein share: time, roles, poses, commands, boxes, interest points.
// Frames: W world (ENU), B body (FLU), C camera (x optical axis, y left, z up), L lidar.  Units: SI, radians.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "core/ids.hpp"

namespace skein {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Simulated time as a number of physics ticks of 2.5 ms. Ages and periods are Ticks, never doubles.
using Tick = std::int64_t;
inline constexpr double kTickS = 0.0025;
inline constexpr Tick kTicksPerSecond = 400;

/// Simulated seconds at a tick.
inline double seconds(Tick tick) { return static_cast<double>(tick) * kTickS; }
/// The tick nearest to a time in seconds.
inline Tick ticks(double s) { return static_cast<Tick>(s / kTickS + (s < 0 ? -0.5 : 0.5)); }

/// Name of an enum's value in files and messages. To give an enum names, define enum_names() next to it.
template <class Enum>
struct EnumName {
  const char* name;
  Enum value;
};

enum class Role { explorer, photographer };
constexpr std::array<EnumName<Role>, 2> enum_names(Role) {
  return {{{"explorer", Role::explorer}, {"photographer", Role::photographer}}};
}

/// The name of an enum's value; "?" for a value without one.
template <class Enum>
std::string name_of(Enum value) {
  for (const auto& entry : enum_names(value)) {
    if (entry.value == value) return entry.name;
  }
  return "?";
}

/// The user's input is wrong. Programs print what() and exit with code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// State of a rigid body at one instant.
struct RigidBodyState {
  Vector3d p_WB = Vector3d::Zero();            ///< position [m]
  Quaterniond q_WB = Quaterniond::Identity();  ///< attitude, body to world
  Vector3d v_WB = Vector3d::Zero();            ///< velocity of Bo in W, expressed in W [m/s]
  Vector3d w_WB_B = Vector3d::Zero();          ///< angular velocity, expressed in B [rad/s]

  Isometry3d X_WB() const { return Eigen::Translation3d(p_WB) * q_WB; }
};

/// Angles of the gimbal relative to the body's heading (the gimbal cancels roll and pitch of the body):
/// R_WC = Rz(yaw of body) Rz(yaw) Ry(pitch). Positive yaw turns left, positive pitch looks down.
struct GimbalState {
  double pitch = 0.0, yaw = 0.0;            ///< [rad]
  double pitch_rate = 0.0, yaw_rate = 0.0;  ///< [rad/s]
};

/// State, at the instant of a scan, of the servo that turns an explorer's LiDAR about the x axis of B.
struct LidarServo {
  Tick tick = 0;
  double angle = 0.0;  ///< [rad]
  double rate = 0.0;   ///< [rad/s]; 0 at a stop
};

/// One setpoint for CARIC's flight controller. Position [m], velocity [m/s] and acceleration [m/s^2] in W.
/// |p_WB| < 0.01 m means "no position", see docs/rules.md.
struct TrajectoryCommand {
  Vector3d p_WB = Vector3d::Zero();
  Vector3d v_WB = Vector3d::Zero();
  Vector3d a_WB = Vector3d::Zero();
  double yaw = 0.0;       ///< [rad]
  double yaw_rate = 0.0;  ///< [rad/s]; only checked against the vehicle's limit, the control law does not use it
};

enum class GimbalMode { angle, rate, freeze };

struct GimbalCommand {
  GimbalMode mode = GimbalMode::freeze;
  double pitch = 0.0, yaw = 0.0;  ///< angles [rad] or rates [rad/s], by mode
};

/// Oriented box, the only description of a structure that an agent receives. Frame O has the axes of the box.
struct OrientedBox {
  std::string name;
  Vector3d center = Vector3d::Zero();    ///< [m], in W
  Vector3d size = Vector3d::Zero();      ///< full edge lengths along the box's axes [m]
  Matrix3d R_WO = Matrix3d::Identity();  ///< box axes in W

  bool contains(const Vector3d& p_W, double margin = 0.0) const {
    const Vector3d p_O = R_WO.transpose() * (p_W - center);
    return (p_O.cwiseAbs().array() <= (0.5 * size).array() + margin).all();
  }
};

struct InterestPoint {
  Eigen::Vector3f p_W;  ///< [m]; single precision, as the reference keeps it
  Eigen::Vector3f n_W;  ///< unit normal; its sign does not matter
};

}  // namespace skein
