#include "sight/camera.hpp"

#include <algorithm>
#include <cmath>

#include "core/camera_quality.hpp"
#include "core/euler.hpp"
#include "core/normals.hpp"

namespace skein::sim {

bool in_sight(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world) {
  const Vector3d ray = p_W - p_WC;
  const double distance = ray.norm();
  RayFilter filter;
  filter.except_uav = own_uav;
  // Hits beyond the tolerance do not matter. The ray is a little longer, so that a hit at the tolerance is not cut off.
  const auto hit = world.first_hit(p_WC, ray, distance + 2.0 * Camera::kSurfaceTolerance, filter);
  return hit && std::abs(hit->distance - distance) <= Camera::kSurfaceTolerance;
}

bool in_sight_of_reference(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world) {
  RayFilter filter;
  filter.except_uav = own_uav;
  const auto hit = world.first_hit_before_end(p_WC, p_W, filter);
  return hit && hit->length - hit->distance <= static_cast<float>(Camera::kSurfaceTolerance);
}

namespace {

/// The camera is not part of the collision shape: it may pass through a roof below its body.
bool is_through_structure(const Vector3d& p_WB, const Vector3d& p_WC, const RayScene& world) {
  return world.first_hit_distance(p_WB, p_WC, {.ground = false, .uavs = false}).has_value();
}

}  // namespace

bool Capture::improved() const { return std::ranges::any_of(detections, &Detection::improved); }

Camera::Camera(const CameraConfig& config, double desired_mm_per_pixel, const RulesConfig& rules,
               const std::vector<InterestPoint>& points, UavIndex uav, const CameraConditions& conditions,
               std::uint64_t seed)
    : rated_exposure_s_(config.exposure_s),
      config_(config),
      seed_(seed),
      desired_mm_per_pixel_(desired_mm_per_pixel),
      rules_(rules),
      points_(points),
      uav_(uav),
      interval_(ticks(config.trigger_interval_s)),
      best_(points.size(), 0.0F),
      seen_(points.size(), false) {
  change_conditions(conditions);
}

void Camera::change_conditions(const CameraConditions& conditions) {
  config_.exposure_s = rated_exposure_s_ * conditions.exposure_factor;
  vibration_ = conditions.vibration_deg_s * kRadPerDeg;
}

template <class Judge>
void Camera::for_each_in_view(const RigidBodyState& body, const GimbalState& gimbal, const RayScene& world,
                              const Judge& judge) const {
  CameraState state = camera_state(body, gimbal, config_);
  if (vibration_ > 0.0) {
    RandomStream draw(seed_, "vibration", uav_, captures_);
    state.w_WC += vibration_ * normals(draw);
  }
  const Exposure exposure(state, config_, desired_mm_per_pixel_, rules_);
  const Vector3d& p_WC = exposure.position();
  if (rules_.camera_blind_in_structure && is_through_structure(body.p_WB, p_WC, world)) return;
  const SightTest sees = sight_test(rules_);
  const UavIndex sees_through = rules_.own_body_hides ? kNobody : uav_;
  // Most points of a scene are outside the search radius: a fast test in single precision, with a margin, drops them.
  const Eigen::Vector3f centre = p_WC.cast<float>();
  const float reach = static_cast<float>(exposure.radius()) + 0.01F;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if ((points_[i].p_W - centre).squaredNorm() > reach * reach) continue;
    const Vector3d p_W = points_[i].p_W.cast<double>();
    const auto p_C = exposure.view(p_W);
    if (!p_C) continue;
    judge(i, exposure.score(*p_C, points_[i].n_W.cast<double>()), [&] { return sees(p_WC, p_W, sees_through, world); });
  }
}

Capture Camera::capture(Tick tick, const RigidBodyState& body, const GimbalState& gimbal, const RayScene& world,
                        const OtherStates& other) {
  Capture capture{tick, {}};
  last_ = tick;
  for_each_in_view(body, gimbal, world, [&](std::uint32_t i, const auto& quality, const auto& in_sight) {
    const double q = quality ? quality->score() : 0.0;
    const bool counts = q > 0.0 && q >= rules_.min_point_score;  // false for NaN
    // The ray comes last: it costs more than all formulas together. A point that does not count needs a ray only until
    // it has been seen once.
    if ((!counts && seen_[i]) || !in_sight()) return;
    seen_[i] = true;
    if (!counts) return;
    const bool improved = static_cast<float>(q) > best_[i];
    best_[i] = std::max(best_[i], static_cast<float>(q));
    capture.detections.push_back({i, quality->q_blur, quality->q_res, quality->q_distance, q, best_[i], improved});
  });
  imagine(other.exact, gimbal, world, best_if_exact_);
  imagine(other.calm, gimbal, world, best_if_calm_);
  ++captures_;
  return capture;
}

void Camera::imagine(const std::optional<RigidBodyState>& body, const GimbalState& gimbal, const RayScene& world,
                     std::vector<float>& best_if) const {
  if (!body) return;
  best_if.resize(points_.size(), 0.0F);
  for_each_in_view(*body, gimbal, world, [&](std::uint32_t i, const auto& quality, const auto& in_sight) {
    const double q = quality ? quality->score() : 0.0;
    const bool better = q >= rules_.min_point_score && static_cast<float>(q) > std::max(best_[i], best_if[i]);
    if (better && in_sight()) best_if[i] = static_cast<float>(q);
  });
}

}  // namespace skein::sim
