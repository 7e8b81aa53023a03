#include "sim_server/plan/views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/math/euler.hpp"
#include "core/scoring/camera_quality.hpp"
#include "oracle/share_out.hpp"
#include "sight/camera.hpp"

namespace skein::sim {
namespace {

/// Distances of the camera, as shares of the distance with full resolution times the cosine of the tilt.
constexpr std::array<double, 6> kDistances = {2.0, 1.55, 1.25, 0.97, 0.7, 0.45};
constexpr std::array<double, 2> kTilts = {30.0 * kRadPerDeg, 55.0 * kRadPerDeg};
constexpr int kAzimuths = 4;
constexpr double kFinestSpacing = 0.5, kCoarser = 1.2;  ///< spacing of places for views [m]; factor between spacings
constexpr double kLeastWorth = 0.2;
constexpr float kEnoughShown = 2.0F;  ///< sum of qualities in kept views at which a point counts half

/// Cell of the grid, and the axis that is closest to the surface normal, regardless of sign.
using Patch = std::tuple<long, long, long, int>;

Patch patch_of(const InterestPoint& point, double spacing) {
  const Vector3d cell = (point.p_W.cast<double>() / spacing).array().floor();
  int axis = 0;
  point.n_W.cwiseAbs().maxCoeff(&axis);
  return {std::lround(cell.x()), std::lround(cell.y()), std::lround(cell.z()), axis};
}

/// One point of each patch of the surface. Uses the finest spacing that gives no more than `most` patches.
std::vector<std::size_t> seeds_of(const std::vector<InterestPoint>& points, std::size_t most) {
  for (double spacing = kFinestSpacing;; spacing *= kCoarser) {
    std::vector<std::pair<Patch, std::size_t>> patches;
    for (std::size_t i = 0; i < points.size(); ++i) patches.emplace_back(patch_of(points[i], spacing), i);
    std::ranges::sort(patches);
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    patches.erase(std::unique(patches.begin(), patches.end(), same), patches.end());
    if (patches.size() > most) continue;
    std::vector<std::size_t> seeds;
    for (const auto& [patch, point] : patches) seeds.push_back(point);
    return seeds;
  }
}

struct Way {
  Vector3d direction;  ///< from the point to the camera
  double stretch;      ///< factor on the distances
};

std::vector<Way> ways_from(const Vector3d& n_W) {
  std::vector<Way> ways;
  for (const double side : {1.0, -1.0}) {
    const Vector3d n = side * n_W, u = n.unitOrthogonal(), v = n.cross(u);
    ways.push_back({n, 1.0});
    for (std::size_t ring = 0; ring < kTilts.size(); ++ring) {
      for (int i = 0; i < kAzimuths; ++i) {
        const double azimuth = (i + 0.5 * static_cast<double>(ring)) * 2.0 * std::numbers::pi / kAzimuths;
        const Vector3d aside = std::cos(azimuth) * u + std::sin(azimuth) * v;
        ways.push_back({std::cos(kTilts[ring]) * n + std::sin(kTilts[ring]) * aside, std::cos(kTilts[ring])});
      }
    }
  }
  return ways;
}

/// Takes pictures for one kind of UAV, on one thread.
class Photographer {
 public:
  Photographer(const Scenario& scenario, const Scene& scene, const TeamKind& kind, std::size_t index)
      : kind_(kind),
        index_(index),
        points_(scene.points),
        mount_(kind.camera, scenario.rules.own_body_hides),
        world_(scene.mesh, {kind.body}),
        camera_(kind.vehicle.camera, scenario.desired_mm_per_pixel, scenario.rules, scene.points, UavIndex{}),
        full_distance_(resolution_distance(kind.vehicle.camera, scenario.desired_mm_per_pixel)) {}

  void views_of(std::size_t seed, std::vector<View>& views) {
    const Vector3d p_W = points_[seed].p_W.cast<double>();
    for (const Way& way : ways_from(points_[seed].n_W.cast<double>().normalized())) {
      for (const double part : kDistances) {
        View view;
        if (!place(p_W, way.direction, part * way.stretch * full_distance_, view)) continue;
        take(view);
        if (gain_of(view, std::vector<float>()) >= kLeastWorth) views.push_back(std::move(view));
      }
    }
  }

 private:
  /// Sets the pose of a view. @returns false if the UAV cannot be there, or does not see the point.
  bool place(const Vector3d& p_W, const Vector3d& direction, double distance, View& view) const {
    const Vector3d p_WC = p_W + distance * direction;
    view.pitch = std::asin(std::clamp(direction.z(), -1.0, 1.0));
    view.yaw = std::atan2(-direction.y(), -direction.x());
    view.kind = index_;
    view.p_WB = mount_.body_centre(p_WC, view.yaw);
    if (std::abs(view.pitch) > kind_.vehicle.gimbal.pitch_limit_deg * kRadPerDeg) return false;
    if (view.p_WB.z() < kLeastHeight || world_.clearance(view.p_WB, kind_.clearance) < kind_.clearance) return false;
    return !world_.first_hit_distance(p_WC, p_W + 2.0 * Camera::kSurfaceTolerance * direction, {.uavs = false});
  }

  void take(View& view) {
    RigidBodyState body;
    body.p_WB = view.p_WB;
    body.q_WB = Eigen::AngleAxisd(view.yaw, Vector3d::UnitZ());
    world_.set_pose(UavIndex{}, body.X_WB());
    const Capture capture = camera_.capture(0, body, {view.pitch, 0.0, 0.0, 0.0}, world_);
    for (const Detection& seen : capture.detections) view.sights.push_back({seen.point, static_cast<float>(seen.q)});
  }

  const TeamKind& kind_;
  std::size_t index_;
  const std::vector<InterestPoint>& points_;
  CameraMount mount_;
  RayScene world_;
  Camera camera_;
  double full_distance_;
};

/// Value of a view in addition to the kept ones: a point counts less the more kept views show it.
double worth_of(const View& view, const std::vector<float>& shown) {
  double worth = 0.0;
  for (const Sight& sight : view.sights) worth += sight.q * sight.q / (kEnoughShown + shown[sight.point]);
  return worth;
}

/// Keeps the views that show many points, or points that few others show. Lazy greedy selection, because the value of a
/// view never rises while others are kept.
std::vector<View> worthiest(std::vector<View> views, std::size_t points, std::size_t most) {
  if (views.size() <= most) return views;
  std::vector<float> shown(points, 0.0F);
  std::vector<std::pair<double, std::size_t>> heap;
  for (std::size_t i = 0; i < views.size(); ++i) heap.emplace_back(worth_of(views[i], shown), views.size() - i);
  std::make_heap(heap.begin(), heap.end());
  std::vector<View> kept;
  while (kept.size() < most) {
    std::pop_heap(heap.begin(), heap.end());
    auto& [worth, number] = heap.back();
    View& view = views[views.size() - number];
    worth = worth_of(view, shown);
    if (heap.size() > 1 && worth < heap.front().first) {
      std::push_heap(heap.begin(), heap.end());
      continue;
    }
    for (const Sight& sight : view.sights) shown[sight.point] += sight.q;
    kept.push_back(std::move(view));
    heap.pop_back();
  }
  return kept;
}

}  // namespace

double gain_of(const View& view, const std::vector<float>& best) {
  double gain = 0.0;
  for (const Sight& sight : view.sights) {
    const float had = best.empty() ? 0.0F : best[sight.point];
    if (sight.q > had) gain += sight.q - had;
  }
  return gain;
}

std::vector<View> make_views(const Scenario& scenario, const Scene& scene, const Team& team, const PlanConfig& config) {
  const std::vector<std::size_t> seeds = seeds_of(scene.points, config.most_seeds);
  const std::size_t lots = std::max(1U, config.threads);
  std::vector<View> all;
  for (std::size_t k = 0; k < team.kinds.size(); ++k) {
    std::vector<std::vector<View>> by_seed(seeds.size());
    share_out(lots, config.threads, [&](std::size_t lot) {
      Photographer photographer(scenario, scene, team.kinds[k], k);
      for (std::size_t i = lot; i < seeds.size(); i += lots) photographer.views_of(seeds[i], by_seed[i]);
    });
    std::vector<View> views;
    for (std::vector<View>& some : by_seed) std::ranges::move(some, std::back_inserter(views));
    std::ranges::move(worthiest(std::move(views), scene.points.size(), config.most_views), std::back_inserter(all));
  }
  return all;
}

}  // namespace skein::sim
