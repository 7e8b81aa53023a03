#include "sim_server/camera.hpp"

#include <algorithm>
#include <cmath>

#include "core/camera_quality.hpp"

namespace skein::sim {

bool in_sight(const Vector3d& p_WC, const Vector3d& p_W, std::size_t own_uav, const RayScene& world) {
  const Vector3d ray = p_W - p_WC;
  const double distance = ray.norm();
  RayFilter filter;
  filter.except_uav = own_uav;
  // Beyond the tolerance nothing matters; a little more, so that a hit at its very end is not cut off.
  const auto hit = world.first_hit(p_WC, ray, distance + 2.0 * Camera::kSurfaceTolerance, filter);
  return hit && std::abs(hit->distance - distance) <= Camera::kSurfaceTolerance;
}

bool Capture::improved() const { return std::ranges::any_of(detections, &Detection::improved); }

Camera::Camera(const CameraConfig& config, double desired_mm_per_pixel, const RulesConfig& rules,
               const std::vector<InterestPoint>& points, std::size_t uav)
    : config_(config),
      desired_mm_per_pixel_(desired_mm_per_pixel),
      rules_(rules),
      points_(points),
      uav_(uav),
      interval_(ticks(config.trigger_interval_s)),
      best_(points.size(), 0.0F),
      seen_(points.size(), false) {}

Capture Camera::capture(Tick tick, const RigidBodyState& body, const GimbalState& gimbal, const RayScene& world) {
  const Exposure exposure(camera_state(body, gimbal, config_), config_, desired_mm_per_pixel_, rules_);
  const Vector3d& p_WC = exposure.position();
  // A first sieve in single precision, a hair wide: most points of a scene are out of reach.
  const Eigen::Vector3f centre = p_WC.cast<float>();
  const float reach = static_cast<float>(exposure.radius()) + 0.01F;

  Capture capture{tick, next_number_++, {}};
  last_ = tick;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if ((points_[i].p_W - centre).squaredNorm() > reach * reach) {
      continue;
    }
    const Vector3d p_W = points_[i].p_W.cast<double>();
    const auto p_C = exposure.view(p_W);
    if (!p_C) {
      continue;
    }
    const auto quality = exposure.score(*p_C, points_[i].n_W.cast<double>());
    const bool counts = quality && quality->score() >= rules_.min_point_score;
    // The ray comes last: it costs more than all formulas together. Of what does not count it is asked until the point
    // has been seen once.
    if ((!counts && seen_[i]) || !in_sight(p_WC, p_W, uav_, world)) {
      continue;
    }
    seen_[i] = true;
    if (!counts) {
      continue;
    }
    const double q = quality->score();
    const bool improved = static_cast<float>(q) > best_[i];
    best_[i] = std::max(best_[i], static_cast<float>(q));
    capture.detections.push_back({i, quality->q_blur, quality->q_res, quality->q_distance, q, best_[i], improved});
  }
  return capture;
}

}  // namespace skein::sim
