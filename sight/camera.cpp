#include "sight/camera.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "core/math/normals.hpp"
#include "core/scoring/camera_quality.hpp"

namespace skein::sim {

namespace {

/// How far a camera may move until the points near it are searched again: far enough for some seconds of flight, but
/// small compared with the search radius.
constexpr double kNearSlack_m = 2.0;

/// The first hit of the ray from a camera to a point, or any body or ground before the point.
std::optional<Hit> hit_towards(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world) {
  const Vector3d ray = p_W - p_WC;
  const double distance = ray.norm();
  RayFilter filter;
  filter.except_uav = own_uav;
  // Hits beyond the tolerance do not matter. The ray is a little longer, so that a hit at the tolerance is not cut off.
  return world.first_hit_or_blocker(p_WC, ray, distance + 2.0 * Camera::kSurfaceTolerance,
                                    distance - Camera::kSurfaceTolerance, filter);
}

bool is_at(const std::optional<Hit>& hit, double distance) {
  return hit && std::abs(hit->distance - distance) <= Camera::kSurfaceTolerance;
}

}  // namespace

bool in_sight(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world) {
  return is_at(hit_towards(p_WC, p_W, own_uav, world), (p_W - p_WC).norm());
}

bool in_sight_of_reference(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world) {
  RayFilter filter;
  filter.except_uav = own_uav;
  const auto hit = world.first_hit_before_end(p_WC, p_W, filter);
  return hit && hit->length - hit->distance <= static_cast<float>(Camera::kSurfaceTolerance);
}

namespace {

/// Whether structure is between body and camera. The camera is not part of the collision shape, so it can pass through
/// a roof below its body.
bool is_through_structure(const Vector3d& p_WB, const Vector3d& p_WC, const RayScene& world) {
  return world.first_hit_distance(p_WB, p_WC, {.ground = false, .uavs = false}).has_value();
}

PoorSight poor_sight(std::uint32_t point, const PointScore& quality) {
  return {point, static_cast<float>(quality.score()), static_cast<float>(quality.q_blur),
          static_cast<float>(quality.q_res), static_cast<float>(quality.q_distance)};
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
      seen_(points.size(), false),
      blockers_(points.size(), kNoTriangle) {
  change_conditions(conditions);
}

void Camera::change_conditions(const CameraConditions& conditions) {
  config_.exposure_s = rated_exposure_s_ * conditions.exposure_factor;
  vibration_ = conditions.vibration_deg_s * kRadPerDeg;
}

struct Camera::View {
  Vector3d p_WB;
  Exposure exposure;
};

Camera::View Camera::view_of(const RigidBodyState& body, const GimbalState& gimbal, const Vector3d& shake_W) const {
  CameraState state = camera_state(body, gimbal, config_);
  state.w_WC += shake_W;
  return {body.p_WB, Exposure(state, config_, desired_mm_per_pixel_, rules_)};
}

void Camera::find_near(const std::array<const View*, 3>& views) {
  const auto within = [&](const View* view) {
    return view == nullptr || (view->exposure.position() - *near_centre_).norm() <= kNearSlack_m;
  };
  if (near_centre_ && std::ranges::all_of(views, within)) return;
  near_centre_ = views.front()->exposure.position();
  double slack_m = kNearSlack_m;
  for (const View* view : views) {
    if (view != nullptr) slack_m = std::max(slack_m, (view->exposure.position() - *near_centre_).norm());
  }
  // In single precision, with a margin for rounding.
  const Eigen::Vector3f centre = near_centre_->cast<float>();
  const float reach = static_cast<float>(views.front()->exposure.radius() + slack_m) + 0.01F;
  near_.clear();
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (!((points_[i].p_W - centre).squaredNorm() > reach * reach)) near_.push_back(i);
  }
}

bool Camera::sees(std::uint32_t point, const Vector3d& p_WC, const Vector3d& p_W, const RayScene& world) {
  const UavIndex sees_through = rules_.own_body_hides ? kNoUav : uav_;
  if (rules_.ray_ends_at_point) return in_sight_of_reference(p_WC, p_W, sees_through, world);
  const double distance = (p_W - p_WC).norm();
  for (const std::uint32_t known : {blockers_[point], last_blocker_}) {
    if (world.surely_blocked_by(known, p_WC, p_W, distance - kSurfaceTolerance)) return false;
  }
  const auto hit = hit_towards(p_WC, p_W, sees_through, world);
  const bool seen = is_at(hit, distance);
  blockers_[point] = hit && !seen ? hit->triangle : kNoTriangle;
  if (blockers_[point] != kNoTriangle) last_blocker_ = blockers_[point];
  return seen;
}

template <class Judge>
void Camera::for_each_in_view(const View& view, const RayScene& world, const Judge& judge) {
  const Vector3d& p_WC = view.exposure.position();
  std::optional<bool> blind;  // computed only on demand: it costs a ray, too
  for (const std::uint32_t i : near_) {
    const Vector3d p_W = points_[i].p_W.cast<double>();
    const auto p_C = view.exposure.view(p_W);
    if (!p_C) continue;
    judge(i, view.exposure.score(*p_C, points_[i].n_W.cast<double>()), [&] {
      if (!blind) blind = rules_.camera_blind_in_structure && is_through_structure(view.p_WB, p_WC, world);
      return !*blind && sees(i, p_WC, p_W, world);
    });
  }
}

Capture Camera::capture(Tick tick, const RigidBodyState& body, const GimbalState& gimbal, const RayScene& world,
                        const OtherStates& other, const PoorPictures* poor) {
  Capture capture{tick, {}, {}};
  last_ = tick;
  Vector3d shake_W = Vector3d::Zero();
  if (vibration_ > 0.0) {
    RandomStream draw(seed_, "vibration", uav_, captures_);
    shake_W = vibration_ * normals(draw);
  }
  const View view = view_of(body, gimbal, shake_W);
  const auto exact = other.exact ? std::optional(view_of(*other.exact, gimbal, shake_W)) : std::nullopt;
  const auto calm = other.calm ? std::optional(view_of(*other.calm, gimbal, shake_W)) : std::nullopt;
  find_near({&view, exact ? &*exact : nullptr, calm ? &*calm : nullptr});
  for_each_in_view(view, world, [&](std::uint32_t i, const auto& quality, const auto& in_sight) {
    const double q = quality ? quality->score() : 0.0;
    const bool counts = q > 0.0 && q >= rules_.min_point_score;  // false for NaN
    // The ray comes last: it costs more than all formulas together. A point that does not count needs a ray only until
    // it has been seen once, and in a picture that would be the best of those that do not count for it.
    const bool best_poor = !counts && quality && poor != nullptr && poor->would_be_best(i, static_cast<float>(q));
    if ((!counts && seen_[i] && !best_poor) || !in_sight()) return;
    seen_[i] = true;
    if (best_poor) capture.poor.push_back(poor_sight(i, *quality));
    if (!counts) return;
    const bool improved = static_cast<float>(q) > best_[i];
    best_[i] = std::max(best_[i], static_cast<float>(q));
    capture.detections.push_back({i, quality->q_blur, quality->q_res, quality->q_distance, q, best_[i], improved});
  });
  if (exact) imagine(*exact, world, best_if_exact_);
  if (calm) imagine(*calm, world, best_if_calm_);
  ++captures_;
  return capture;
}

void Camera::imagine(const View& view, const RayScene& world, std::vector<float>& best_if) {
  best_if.resize(points_.size(), 0.0F);
  for_each_in_view(view, world, [&](std::uint32_t i, const auto& quality, const auto& in_sight) {
    const double q = quality ? quality->score() : 0.0;
    const bool better = q >= rules_.min_point_score && static_cast<float>(q) > std::max(best_[i], best_if[i]);
    if (better && in_sight()) best_if[i] = static_cast<float>(q);
  });
}

}  // namespace skein::sim
