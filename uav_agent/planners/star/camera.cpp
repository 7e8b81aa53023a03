#include "uav_agent/planners/star/camera.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

constexpr double kSameViewM = 1.0;  ///< a viewpoint that was moved by less is the same one; chosen
constexpr double kStraightM = 1.0;  ///< a point with a smaller horizontal distance gives no yaw; chosen

double pitch_to(const Vector3d& way) { return std::atan2(-way.z(), way.head<2>().norm()); }
double yaw_to(const Vector3d& way) { return std::atan2(way.y(), way.x()); }

double yaw_of(const RigidBodyState& state) { return roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw; }

}  // namespace

StarCamera::StarCamera(const VehicleConfig& vehicle, bool turns_body)
    : yaw_limit_(vehicle.gimbal.yaw_limit_deg * kRadPerDeg), turns_body_(turns_body) {}

void StarCamera::turn(double yaw, double pitch, const RigidBodyState& state, PlannerOutput& out) const {
  if (turns_body_) out.yaw = wrap_angle(yaw);
  const double aside = turns_body_ ? 0.0 : std::clamp(wrap_angle(yaw - yaw_of(state)), -yaw_limit_, yaw_limit_);
  out.gimbal = GimbalCommand{GimbalMode::angle, pitch, aside};
}

void StarCamera::sweep(const RigidBodyState& state, const GimbalState& gimbal, const Vector3d& p_view_W,
                       const Vector3d& surface_W, PlannerOutput& out) {
  const double to_go = (p_view_W - state.p_WB).norm();
  if (!sweep_ || (sweep_->p_view_W - p_view_W).norm() > kSameViewM) {
    sweep_ = Sweep{p_view_W, yaw_of(state) + gimbal.yaw, gimbal.pitch, to_go};
  }
  const double share = sweep_->distance > 0.0 ? std::clamp(1.0 - to_go / sweep_->distance, 0.0, 1.0) : 1.0;
  const Vector3d way = surface_W - p_view_W;
  const double yaw = way.head<2>().norm() > kStraightM ? yaw_to(way) : sweep_->yaw;
  turn(sweep_->yaw + share * wrap_angle(yaw - sweep_->yaw), sweep_->pitch + share * (pitch_to(way) - sweep_->pitch),
       state, out);
}

void StarCamera::look_at(const RigidBodyState& state, const Vector3d& p_W, PlannerOutput& out) {
  sweep_.reset();
  const Vector3d way = p_W - state.p_WB;
  turn(way.head<2>().norm() > kStraightM ? yaw_to(way) : yaw_of(state), pitch_to(way), state, out);
}

}  // namespace skein::agent
