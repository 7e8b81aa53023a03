// Aims STAR's camera: body and gimbal turn continuously on the way from one viewpoint to the next, so that the camera
// looks at a viewpoint's surface just when the UAV passes the viewpoint, and never rests.
// Frame W.   Units: SI and radians.   Threads: one.
// Source: paper ("continuous camera movement", "continuous yawing motion"); that the body turns in yaw and
// the gimbal in pitch, both in proportion to the distance flown, is our choice. A UAV with a LiDAR flies with its body
// along its path (flight_core/navigator.hpp): there, the gimbal alone turns.
#pragma once

#include <optional>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class StarCamera {
 public:
  /// @param turns_body  whether the body turns in yaw; otherwise the gimbal alone turns.
  StarCamera(const VehicleConfig& vehicle, bool turns_body);

  /// Turns the camera towards the surface of the next viewpoint.
  /// @param p_view_W  the viewpoint.   @param surface_W  the surface to be seen from there.
  void sweep(const RigidBodyState& state, const GimbalState& gimbal, const Vector3d& p_view_W,
             const Vector3d& surface_W, PlannerOutput& out);
  /// Points the camera at p_W.
  void look_at(const RigidBodyState& state, const Vector3d& p_W, PlannerOutput& out);

 private:
  void turn(double yaw, double pitch, const RigidBodyState& state, PlannerOutput& out) const;

  struct Sweep {
    Vector3d p_view_W = Vector3d::Zero();
    double yaw = 0.0, pitch = 0.0;  ///< direction of the camera when the sweep began
    double distance = 0.0;          ///< distance to the viewpoint then
  };

  double yaw_limit_;
  bool turns_body_;
  std::optional<Sweep> sweep_;
};

}  // namespace skein::agent
