#include "sim_server/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim_server/best_aim.hpp"
#include "sim_server/open_space.hpp"
#include "sim_server/share_out.hpp"
#include "sim_server/view_search.hpp"

namespace skein::sim {
namespace {

std::vector<BestAim> aims_of(const Scenario& scenario) {
  std::vector<BestAim> aims;
  for (const CameraKind& kind : camera_kinds(scenario)) {
    aims.emplace_back(kind, scenario.desired_mm_per_pixel, scenario.rules);
  }
  return aims;
}

std::vector<Vector3d> starts_of(const Scenario& scenario) {
  std::vector<Vector3d> starts;
  for (const UavConfig& uav : scenario.fleet) {
    starts.emplace_back(uav.start.x(), uav.start.y(), 0.5 * uav.vehicle.collision_box_m.z());
  }
  return starts;
}

Eigen::AlignedBox3d extent(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box(Vector3d::Zero());
  for (const auto& vertex : mesh.vertices) box.extend(vertex.cast<double>());
  return box;
}

double berth(const OracleConfig& config) { return std::max(config.clearance_m, config.outside_berth_m); }

Attainable sum_up(const std::vector<PointView>& views, double least) {
  Attainable sum;
  for (const PointView& view : views) {
    if (view.q < least || view.q <= 0.0) continue;
    ++sum.points;
    sum.score += view.q;
  }
  return sum;
}

}  // namespace

double expected_seconds(const Scenario& scenario, const Scene& scene, const OracleConfig& config) {
  constexpr double kPerLine = 1.5e-4, kPerLook = 5e-6;
  const double lines = static_cast<double>(OpenSpace::line_count(extent(scene.mesh), config.clearance_m) +
                                           OpenSpace::line_count(extent(scene.mesh), berth(config)));
  const double looks = static_cast<double>(scene.points.size() * config.directions * camera_kinds(scenario).size());
  return (kPerLine * lines + kPerLook * looks) / std::max(1U, config.threads);
}

OracleReport consult_oracle(const Scenario& scenario, const Scene& scene, const OracleConfig& config) {
  if (!(config.clearance_m >= 0.0) || !std::isfinite(config.clearance_m) || config.directions == 0) {
    throw std::invalid_argument("the oracle needs a clearance of 0 m or more, and directions");
  }
  const RayScene world(scene.mesh);
  const std::vector<BestAim> aims = aims_of(scenario);
  const std::vector<Vector3d> starts = starts_of(scenario);
  const OpenSpace within_reach(world, extent(scene.mesh), config.clearance_m, starts, config.threads);
  const OpenSpace in_the_open(world, extent(scene.mesh), berth(config), starts, config.threads);
  const ViewSearch from_reachable(world, aims, config.clearance_m, {&within_reach});
  const ViewSearch from_outside(world, aims, config.clearance_m, {&within_reach, &in_the_open});

  const std::size_t count = scene.points.size();
  std::vector<ViewSearch::Found> reachable(count), outside(count);
  share_out(count, config.threads, [&](std::size_t i) {
    outside[i] = from_outside.find(scene.points[i], config.directions, {});
    reachable[i] = from_reachable.find(scene.points[i], config.directions, outside[i]);
  });

  const auto answer = [&](const std::vector<ViewSearch::Found>& found) {
    std::vector<PointView> coarse, fine;
    for (const ViewSearch::Found& views : found) {
      coarse.push_back(views.coarse);
      fine.push_back(views.fine);
    }
    const double least = scenario.rules.min_point_score;
    return OracleAnswer{fine, sum_up(fine, least), sum_up(coarse, least)};
  };
  return {answer(reachable), answer(outside)};
}

}  // namespace skein::sim
