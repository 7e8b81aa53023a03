#include "sight/camera_mount.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

constexpr double kHeadingStep = 2.0 * std::numbers::pi / BodyHeadings::kCount;

/// Cosine and sine of every heading, counted from the first.
const std::array<Vector2d, BodyHeadings::kCount> kTurns = [] {
  std::array<Vector2d, BodyHeadings::kCount> turns;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const double angle = static_cast<double>(i) * kHeadingStep;
    turns[i] = {std::cos(angle), std::sin(angle)};
  }
  return turns;
}();

/// v turned about the vertical.
Vector3d turned(const Vector3d& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

}  // namespace

std::array<double, 5> CameraKind::optics() const {
  return {camera.hfov_deg, camera.vfov_deg, camera.focal_length_m, camera.pixel_size_m, gimbal.pitch_limit_deg};
}

std::vector<double> CameraKind::essence() const {
  const auto seen = optics();
  std::vector<double> all(seen.begin(), seen.end());
  all.insert(all.end(), {gimbal.yaw_limit_deg, camera.p_BC.x(), camera.p_BC.y(), camera.p_BC.z(), body.box_m.x(),
                         body.box_m.y(), body.box_m.z(), body.arm_m, body.rotor_radius_m, body.rotor_height_m});
  for (const BodyBox& link : body.links) {
    all.insert(all.end(), link.p_B.begin(), link.p_B.end());
    all.insert(all.end(), link.edges_m.begin(), link.edges_m.end());
  }
  return all;
}

std::vector<CameraKind> camera_kinds(const Scenario& scenario) {
  std::vector<CameraKind> kinds;
  for (const UavConfig& uav : scenario.fleet) {
    const CameraKind kind{uav.vehicle.camera, uav.vehicle.gimbal, body_shape(uav.vehicle)};
    const auto same = [&kind](const CameraKind& other) { return other.essence() == kind.essence(); };
    if (std::ranges::none_of(kinds, same)) kinds.push_back(kind);
  }
  return kinds;
}

double BodyHeadings::yaw(std::size_t i) const { return wrap_angle(first + static_cast<double>(i) * kHeadingStep); }

CameraMount::CameraMount(const CameraKind& kind, bool body_hides)
    : p_BC_(kind.camera.p_BC),
      body_(kind.body),
      body_hides_(body_hides),
      yaw_limit_(kind.gimbal.yaw_limit_deg * kRadPerDeg) {}

BodyHeadings CameraMount::clear_headings(const Vector3d& ray_W) const {
  BodyHeadings headings{std::atan2(ray_W.y(), ray_W.x()), {}};
  // If the camera hangs below its body and does not look up, no part of the body is in its view.
  double lowest = std::min(-0.5 * body_.shape.box_m.z(), body_.shape.rotor_height_m);
  for (const BodyBox& link : body_.shape.links) lowest = std::min(lowest, link.p_B.z() - 0.5 * link.edges_m.z());
  const bool below = p_BC_.z() < lowest;
  if (!body_hides_ || (below && ray_W.z() <= 0.0)) {
    headings.allowed.set();
    return headings;
  }
  // Body heading i is the ray's azimuth plus turn i, so in B the ray is turned by the opposite angle.
  const double across = ray_W.head<2>().norm();
  for (std::size_t i = 0; i < BodyHeadings::kCount; ++i) {
    const Vector3d ray_B(across * kTurns[i].x(), -across * kTurns[i].y(), ray_W.z());
    headings.allowed[i] = body_.distance({p_BC_, ray_B}) == kInfinity;
  }
  return headings;
}

std::optional<std::size_t> CameraMount::nearest_heading(const BodyHeadings& headings, double camera_yaw) const {
  std::optional<std::size_t> best;
  double least_turn = yaw_limit_;
  for (std::size_t i = 0; i < BodyHeadings::kCount; ++i) {
    if (!headings.allowed[i]) continue;
    const double turn = std::abs(wrap_angle(camera_yaw - headings.yaw(i)));
    if (turn > least_turn || (best && turn == least_turn)) continue;
    best = i;
    least_turn = turn;
  }
  return best;
}

Vector3d CameraMount::body_centre(const Vector3d& p_WC, double body_yaw) const {
  return p_WC - turned(p_BC_, body_yaw);
}

}  // namespace skein::sim
