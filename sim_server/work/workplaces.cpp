#include "sim_server/work/workplaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/scoring/camera_quality.hpp"
#include "oracle/best_aim.hpp"
#include "oracle/open_space.hpp"
#include "sight/camera_mount.hpp"
#include "sight/clear_line.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {
namespace {

constexpr double kNear = 0.85, kLowestPlace = 1.5, kLean = 0.6, kOffSurface = 0.02;
constexpr double kBerthSlack = 0.1;  ///< tolerance of the clearance along a line [m]
constexpr int kWaysAside = 8;
constexpr double kAscent = 0.5;  ///< slope of the sideways lines out of the structure

class Search {
 public:
  Search(const Scenario& scenario, const Scene& scene) : world_(scene.mesh), station_(scenario.station_position) {
    extent_ = box_around(scene.mesh);
    for (int i = 0; i < kWaysAside; ++i) {
      const double azimuth = 2.0 * std::numbers::pi * i / kWaysAside;
      ways_out_.push_back(Vector3d(std::cos(azimuth), std::sin(azimuth), kAscent).normalized());
    }
  }

  Workplace find(const InterestPoint& point, const BestAim& aim, double full_distance) const {
    const Vector3d p_W = point.p_W.cast<double>(), n_W = point.n_W.cast<double>().normalized();
    for (const double side : {1.0, -1.0}) {
      const Vector3d n = side * n_W, u = n.unitOrthogonal(), v = n.cross(u), from_W = p_W + kOffSurface * n;
      for (const Vector3d& lean : {Vector3d(0, 0, 0), u, Vector3d(-u), v, Vector3d(-v)}) {
        for (const double share : {1.0, 0.7}) {
          const Vector3d place = from_W + share * kNear * full_distance * (n + kLean * lean).normalized();
          if (place.z() < kLowestPlace || !clear(from_W, place) || !leads_out(place, n)) continue;
          const double q = aim.find(p_W - place, n_W).q;
          if (q < Workplaces::kLeastQ) continue;
          return {place, clear(place, station_) ? 0.0 : (place - station_).norm(), q};
        }
      }
    }
    return {};
  }

 private:
  bool clear(const Vector3d& a, const Vector3d& b) const { return !world_.first_hit_distance(a, b, {.ground = false}); }

  bool leads_out(const Vector3d& place, const Vector3d& n_W) const {
    if (world_.clearance(place, Workplaces::kBerth) < Workplaces::kBerth) return false;
    const auto leads = [&](const Vector3d& direction) {
      return is_clear_line(world_, place, end_of(place, direction), Workplaces::kBerth, kBerthSlack);
    };
    if (leads(Vector3d::UnitZ())) return true;
    if (n_W.z() >= 0.0 && leads(n_W)) return true;
    return std::ranges::any_of(ways_out_, leads);
  }

  /// Where a line leaves the bounding box of the structure.
  Vector3d end_of(const Vector3d& place, const Vector3d& direction) const {
    double length = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      const double slope = direction[axis];
      if (slope == 0.0) continue;
      const double border = slope > 0.0 ? extent_.max()[axis] : extent_.min()[axis];
      length = std::min(length, std::max(0.0, (border - place[axis]) / slope));
    }
    return place + length * direction;
  }

  const RayScene world_;
  const Vector3d station_;
  Eigen::AlignedBox3d extent_;
  std::vector<Vector3d> ways_out_;
};

}  // namespace

Workplaces::Workplaces(const Scenario& scenario, const Scene& scene) {
  const Search search(scenario, scene);
  std::vector<std::array<double, 5>> optics;
  for (const UavConfig& uav : scenario.fleet) {
    const CameraKind kind{uav.vehicle.camera, uav.vehicle.gimbal, {}};
    const auto known = std::ranges::find(optics, kind.optics());
    kind_of_.push_back(static_cast<std::size_t>(known - optics.begin()));
    if (known != optics.end()) continue;
    optics.push_back(kind.optics());
    const BestAim aim(kind, scenario.desired_mm_per_pixel, scenario.rules);
    const double full_distance = resolution_distance(kind.camera, scenario.desired_mm_per_pixel);
    std::vector<Workplace>& places = by_kind_.emplace_back();
    for (const InterestPoint& point : scene.points) places.push_back(search.find(point, aim, full_distance));
  }
}

}  // namespace skein::sim
