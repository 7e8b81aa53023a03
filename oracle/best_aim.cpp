#include "oracle/best_aim.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

constexpr int kTurns = 36;  ///< over the full circle: any heading may show a point straight below
constexpr double kTurnStep = 2.0 * std::numbers::pi / kTurns;
/// Lifts of the coarse grid, as shares of half the vertical field of view.
constexpr std::array<double, 7> kLifts = {0.0, -0.4, 0.4, -0.8, 0.8, -1.0, 1.0};
constexpr double kLeastScore = 0.01;  ///< limits reach() if `min_point_score` is less than this
constexpr double kHopeful = 0.5;      ///< no climb from an aim whose q is less than this share of the best q so far
constexpr double kFinestStep = 0.1 * kRadPerDeg;

/// Distance beyond which no point can have a sufficient quality. The quality is at most
/// (d* / d) sqrt(1 + h^2) sqrt(1 + h^2 + v^2), where h and v are the slopes of the picture's corner and h is the larger
/// one: by this factor, the step along a surface can span more pixels there than in the centre.
double farthest(const CameraConfig& camera, double desired_mm_per_pixel, const RulesConfig& rules) {
  const double a = std::tan(0.5 * camera.hfov_deg * kRadPerDeg), b = std::tan(0.5 * camera.vfov_deg * kRadPerDeg);
  const double larger = std::max(a, b);
  return resolution_distance(camera, desired_mm_per_pixel) * std::sqrt(1.0 + larger * larger) *
         std::sqrt(1.0 + a * a + b * b) / std::max(rules.min_point_score, kLeastScore);
}

}  // namespace

/// An aim with its search variables.
struct BestAim::Try {
  double turn = 0.0;  ///< heading of the camera, relative to the azimuth of the point
  double lift = 0.0;  ///< angle by which the point is above the optical axis, in the vertical plane of the heading
  Aim aim;

  void improve(const Try& other) {
    if (other.aim.q > aim.q) *this = other;
  }
};

/// A heading of the camera, and the point and its normal relative to it.
struct BestAim::Heading {
  double yaw;
  Vector3d ray_Y, n_Y;  ///< in Y, the level frame with the camera's heading
  bool allowed;

  Heading(const Vector3d& ray_W, const Vector3d& n_W, double turn, const std::function<bool(double)>& is_allowed)
      : yaw(wrap_angle(std::atan2(ray_W.y(), ray_W.x()) + turn)), allowed(!is_allowed || is_allowed(yaw)) {
    const Matrix3d R_YW = rotation_z(-yaw);
    ray_Y = R_YW * ray_W;
    n_Y = R_YW * n_W;
  }
};

BestAim::BestAim(const CameraKind& kind, double desired_mm_per_pixel, const RulesConfig& rules)
    : exposure_(CameraState{}, kind.camera, desired_mm_per_pixel, rules),
      pitch_limit_(kind.gimbal.pitch_limit_deg * kRadPerDeg),
      tan_half_hfov_(std::tan(0.5 * kind.camera.hfov_deg * kRadPerDeg)),
      // Slightly less than half, so that rounding cannot push a point at the border out of the picture.
      half_vfov_(0.5 * kind.camera.vfov_deg * kRadPerDeg - 1e-9),
      reach_(std::min(exposure_.radius(), farthest(kind.camera, desired_mm_per_pixel, rules))) {}

Aim BestAim::look(const Heading& heading, double lift) const {
  Aim aim{heading.yaw, wrap_angle(lift - std::atan2(heading.ray_Y.z(), heading.ray_Y.x())), 0.0};
  if (!heading.allowed || std::abs(lift) > half_vfov_ || std::abs(aim.pitch) > pitch_limit_) return aim;
  const Matrix3d R_CY = rotation_y(-aim.pitch);
  if (const auto p_C = exposure_.view(R_CY * heading.ray_Y)) {
    if (const auto score = exposure_.score(*p_C, R_CY * heading.n_Y)) aim.q = score->score();
  }
  return aim;
}

/// Improves an aim by hill climbing, in ever smaller steps of heading and lift.
BestAim::Try BestAim::climb(const Vector3d& ray_W, const Vector3d& n_W, const std::function<bool(double)>& allowed,
                            Try best) const {
  for (double step = 0.5 * kTurnStep; step > kFinestStep && best.aim.q < 1.0;) {
    const Try centre = best;
    // There is a ridge where the two resolutions are equal. On it few directions lead up, so 24 neighbours are tried.
    for (const int side : {-2, -1, 0, 1, 2}) {
      const double turn = centre.turn + side * step;
      const Heading heading(ray_W, n_W, turn, allowed);
      for (const int up : {-2, -1, 0, 1, 2}) {
        const double lift = centre.lift + up * step;
        best.improve({turn, lift, look(heading, lift)});
      }
    }
    if (best.aim.q <= centre.aim.q) step *= 0.5;
  }
  return best;
}

Aim BestAim::find(const Vector3d& ray_W, const Vector3d& n_W, const std::function<bool(double)>& allowed) const {
  if (ray_W.squaredNorm() >= reach_ * reach_) return {};
  Try best{0.0, 0.0, look({ray_W, n_W, 0.0, allowed}, 0.0)};
  if (best.aim.q >= 1.0) return best.aim;
  // The best aim in each quarter of the picture: as the worse of two resolutions counts, each quarter has a local
  // maximum of its own. Each quarter counts twice, since headings away from the point, too, show it if it is far below
  // or above.
  std::array<Try, 8> hills;
  for (int i = -kTurns / 2; i < kTurns / 2; ++i) {
    const double turn = i * kTurnStep;
    const Heading heading(ray_W, n_W, turn, allowed);
    const Vector3d& ray = heading.ray_Y;
    // With this heading, the point is outside the picture at any pitch.
    if (std::abs(ray.y()) > tan_half_hfov_ * std::hypot(ray.x(), ray.z())) continue;
    for (const double part : kLifts) {
      const Try next{turn, part * half_vfov_, look(heading, part * half_vfov_)};
      hills[(ray.y() < 0.0 ? 0 : 1) + (part < 0.0 ? 0 : 2) + (ray.x() < 0.0 ? 0 : 4)].improve(next);
    }
  }
  for (const Try& hill : hills) {
    if (hill.aim.q > kHopeful * best.aim.q && best.aim.q < 1.0) best.improve(climb(ray_W, n_W, allowed, hill));
  }
  return best.aim;
}

}  // namespace skein::sim
