#include "scenes/wild/flyable.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/scoring/camera_quality.hpp"
#include "core/vehicle/airframe.hpp"
#include "oracle/open_space.hpp"
#include "scenes/enclosure.hpp"

namespace skein::sim::wild {
namespace {

constexpr double kBerth = 1.4;       ///< least clearance of a UAV's centre [m]; an explorer's radius is 0.63 m
constexpr double kShare = 0.33;      ///< share of the checked interest points that UAVs must be able to photograph
constexpr std::size_t kLooks = 160;  ///< least number of interest points to check; fewer if the scene has fewer
/// Flight time of a UAV: kDetour times the straight lines, at kSpeed [m/s], plus kFixedS [s]. It must be less than the
/// share kTimeShare of the mission.
constexpr double kSpeed = 4.0, kDetour = 1.5, kFixedS = 25.0, kTimeShare = 0.5;
/// Least height of a viewpoint [m]; tangent of the angle between an oblique view and the surface normal.
constexpr double kLowestView = 1.5, kTilt = 0.6;
constexpr std::size_t kLeastPlaces = 5;  ///< least number of reachable places with line of sight to the station

class Proof {
 public:
  Proof(const Scenario& scenario, const Scene& scene)
      : scenario_(scenario), scene_(scene), world_(scene.mesh), space_(world_, box_around(scene.mesh), kBerth, {}) {}

  bool holds() {
    for (const UavConfig& uav : scenario_.fleet) starts_.emplace_back(uav.start.x(), uav.start.y(), 0.5);
    const bool out = std::ranges::all_of(starts_, [&](const Vector3d& start) { return has_way_out(start); });
    if (!out || is_enclosed(world_, scenario_.station_position)) return false;
    find_places_of_delivery();
    return delivery_.size() >= kLeastPlaces && enough_points();
  }

 private:
  bool clear(const Vector3d& a, const Vector3d& b) const { return !world_.first_hit_distance(a, b, {.ground = false}); }

  bool has_way_out(const Vector3d& start) const {
    return space_.reaches(start + Vector3d(0, 0, 1.0)) && clear(start, start + Vector3d(0, 0, 4.0));
  }

  void find_places_of_delivery() {
    const Vector3d station = scenario_.station_position;
    for (const double away : {4.0, 8.0, 14.0, 22.0, 32.0}) {
      for (const double up : {3.0, 8.0, 16.0}) {
        for (int i = 0; i < 8; ++i) {
          const double heading = 0.25 * std::numbers::pi * i;
          const Vector3d p = station + Vector3d(away * std::cos(heading), away * std::sin(heading), up);
          if (space_.reaches(p) && clear(p, station)) delivery_.push_back(p);
        }
      }
    }
  }

  static double nearest(const std::vector<Vector3d>& places, const Vector3d& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& place : places) least = std::min(least, (place - p).norm());
    return least;
  }

  bool in_time(const Vector3d& view) const {
    const double way = nearest(starts_, view) + nearest(delivery_, view);
    return kDetour * way / kSpeed + kFixedS < kTimeShare * scenario_.duration_s;
  }

  bool can_be_had(const InterestPoint& point, double farthest) const {
    const Vector3d n = point.n_W.cast<double>(), p = point.p_W.cast<double>() + 0.02 * n;
    const Vector3d helper = std::abs(n.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
    const Vector3d u = helper.cross(n).normalized(), v = n.cross(u);
    for (const Vector3d& lean : {Vector3d(0, 0, 0), u, Vector3d(-u), v, Vector3d(-v)}) {
      for (const double share : {1.0, 0.7}) {
        const Vector3d view = p + share * farthest * (n + kTilt * lean).normalized();
        if (view.z() > kLowestView && in_time(view) && clear(p, view) && space_.reaches(view)) return true;
      }
    }
    return false;
  }

  bool enough_points() const {
    const double farthest =
        0.85 * resolution_distance(scenario_.fleet.front().vehicle.camera, scenario_.desired_mm_per_pixel);
    const std::size_t stride = std::max<std::size_t>(1, scene_.points.size() / kLooks);
    std::size_t looked = 0, had = 0;
    for (std::size_t i = 0; i < scene_.points.size(); i += stride, ++looked)
      had += can_be_had(scene_.points[i], farthest);
    return static_cast<double>(had) >= kShare * static_cast<double>(looked);
  }

  const Scenario& scenario_;
  const Scene& scene_;
  const RayScene world_;
  const OpenSpace space_;
  std::vector<Vector3d> starts_, delivery_;
};

}  // namespace

bool is_flyable(const Scenario& scenario, const Scene& scene) { return Proof(scenario, scene).holds(); }

}  // namespace skein::sim::wild
