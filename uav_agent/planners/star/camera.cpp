#include "uav_agent/planners/star/camera.hpp"

#include <algorithm>
#include <cmath>

#include "core/euler.hpp"

namespace skein::agent {
namespace {

constexpr double kSameViewM = 1.0;  ///< a viewpoint that was moved by less is the same one
constexpr double kStraightM = 1.0;  ///< a point straight above or below gives no yaw

double pitch_to(const Vector3d& way) { return std::atan2(-way.z(), way.head<2>().norm()); }
double yaw_to(const Vector3d& way) { return std::atan2(way.y(), way.x()); }

void turn(double yaw, double pitch, PlannerOutput& out) {
  out.yaw = wrap_angle(yaw);
  out.gimbal = GimbalCommand{GimbalMode::angle, pitch, 0.0};
}

}  // namespace

void StarCamera::sweep(const RigidBodyState& state, const GimbalState& gimbal, const Vector3d& p_view_W,
                       const Vector3d& surface_W, PlannerOutput& out) {
  const double body_yaw = roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw;
  const double to_go = (p_view_W - state.p_WB).norm();
  if (!sweep_ || (sweep_->p_view_W - p_view_W).norm() > kSameViewM) {
    sweep_ = Sweep{p_view_W, body_yaw + gimbal.yaw, gimbal.pitch, to_go};
  }
  const double share = sweep_->distance > 0.0 ? std::clamp(1.0 - to_go / sweep_->distance, 0.0, 1.0) : 1.0;
  const Vector3d way = surface_W - p_view_W;
  const double yaw = way.head<2>().norm() > kStraightM ? yaw_to(way) : sweep_->yaw;
  turn(sweep_->yaw + share * wrap_angle(yaw - sweep_->yaw), sweep_->pitch + share * (pitch_to(way) - sweep_->pitch),
       out);
}

void StarCamera::look_at(const RigidBodyState& state, const Vector3d& p_W, PlannerOutput& out) {
  sweep_.reset();
  const Vector3d way = p_W - state.p_WB;
  const double body_yaw = roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw;
  turn(way.head<2>().norm() > kStraightM ? yaw_to(way) : body_yaw, pitch_to(way), out);
}

}  // namespace skein::agent
