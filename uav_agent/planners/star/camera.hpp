// Where STAR's camera looks: body and gimbal turn all the way from one viewpoint to the next, so that the camera looks
// at a viewpoint's surface just when the UAV passes it, and never rests.
// Frame W.   Units: SI and radians.   Threads: one.
// Source: paper ("continuous camera movement", "continuous yawing motion"); that yaw is the body's and pitch the
// gimbal's, and that both follow the way flown, is our choice. A UAV with a LiDAR flies with its body ahead
// (flight_core/navigator.hpp): there, the gimbal does all.
#pragma once

#include <optional>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class StarCamera {
 public:
  /// @param turns_body  else the gimbal alone turns.
  StarCamera(const VehicleConfig& vehicle, bool turns_body);

  /// Turns towards what is to be seen from the viewpoint that comes next.
  /// @param p_view_W  where that is.   @param surface_W  what is to be seen from there.
  void sweep(const RigidBodyState& state, const GimbalState& gimbal, const Vector3d& p_view_W,
             const Vector3d& surface_W, PlannerOutput& out);
  /// Looks at a point.
  void look_at(const RigidBodyState& state, const Vector3d& p_W, PlannerOutput& out);

 private:
  void turn(double yaw, double pitch, const RigidBodyState& state, PlannerOutput& out) const;

  struct Sweep {
    Vector3d p_view_W = Vector3d::Zero();
    double yaw = 0.0, pitch = 0.0;  ///< where the camera looked when it began
    double distance = 0.0;          ///< to the viewpoint then
  };

  double yaw_limit_;
  bool turns_body_;
  std::optional<Sweep> sweep_;
};

}  // namespace skein::agent
