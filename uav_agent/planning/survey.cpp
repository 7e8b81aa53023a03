#include "uav_agent/planning/survey.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

constexpr double kRingStepM = 8.0;  ///< between corners of the ring

double cross(const Vector2d& o, const Vector2d& a, const Vector2d& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

/// Convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= base + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 1e-9) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // it begins the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// The hull moved outwards, corners rounded, as points about kRingStepM apart.
std::vector<Vector2d> ring_around(const std::vector<Vector2d>& hull, double standoff_m) {
  std::vector<Vector2d> ring;
  const std::size_t n = hull.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d a = hull[i], b = hull[(i + 1) % n];
    const Vector2d along = (b - a).normalized();
    const Vector2d out(along.y(), -along.x());
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kRingStepM)));
    for (int j = 0; j <= steps; ++j) ring.push_back(a + (b - a) * (static_cast<double>(j) / steps) + standoff_m * out);
  }
  return ring;
}

}  // namespace

std::vector<Vector3d> survey_ring(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, double standoff_m,
                                  double height_m) {
  if (agent.me().role != Role::explorer || boxes.empty()) return {};
  std::vector<Vector2d> corners;
  for (const OrientedBox& box : boxes) {
    for (int i = 0; i < 8; ++i) {
      const Vector3d unit(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
      corners.push_back((box.center + box.R_WO * unit.cwiseProduct(box.size)).head<2>());
    }
  }
  const std::vector<Vector2d> ring = ring_around(convex_hull(corners), standoff_m);

  // The first explorer's share begins where the ring is nearest to its start, the others' follow at equal
  // distances.
  const FleetMember* first = nullptr;
  std::size_t explorers = 0, rank = 0;
  for (std::size_t i = 0; i < agent.fleet.size(); ++i) {
    if (agent.fleet[i].role != Role::explorer) continue;
    if (!first) first = &agent.fleet[i];
    if (i < agent.self) ++rank;
    ++explorers;
  }
  const Vector2d start = first->p_WB_start.head<2>();
  const auto nearest = std::min_element(ring.begin(), ring.end(), [&](const Vector2d& a, const Vector2d& b) {
    return (a - start).squaredNorm() < (b - start).squaredNorm();
  });
  const auto offset = static_cast<std::size_t>(nearest - ring.begin());
  const std::size_t begin = ring.size() * rank / explorers, end = ring.size() * (rank + 1) / explorers;
  std::vector<Vector3d> share;
  for (std::size_t i = begin; i <= end; ++i) {
    const Vector2d& p = ring[(offset + i) % ring.size()];
    share.emplace_back(p.x(), p.y(), height_m);
  }
  return share;
}

}  // namespace skein::agent
