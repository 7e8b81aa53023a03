#include "scenes/surface_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kCandidatesPerPoint = 8;
constexpr std::size_t kDrawsPerCandidate = 50;  ///< at most, in case the boxes contain only a small part of the surface
constexpr double kLowest = 0.3;                 ///< points below this height are hidden by the ground
constexpr double kCovered = 0.4;                ///< another solid this close in front hides a point
constexpr double kFreeView = 4.5;               ///< length of an unobstructed view
constexpr double kViewHeight = 0.8;             ///< least height of a viewpoint
constexpr double kViewRoom = 0.6;               ///< clearance of a viewpoint, for a UAV
constexpr double kViewTilt = 0.7;               ///< tangent of the angle between an oblique view and the surface normal
constexpr double kLift = 0.001;                 ///< views start this far from the surface; thinner gaps count as none

Vector3d vertex(const TriangleMesh& mesh, std::uint32_t index) { return mesh.vertices[index].cast<double>(); }

/// Determines whether a place is inside any of several overlapping closed surfaces, with a ray straight up. The
/// triangles are stored in a grid of vertical columns.
class SolidQuery {
 public:
  explicit SolidQuery(const TriangleMesh& mesh) : mesh_(mesh) {
    for (const auto& p : mesh.vertices) extent_.extend(Vector2d(p.cast<double>().head<2>()));
    columns_x_ = 1 + static_cast<int>(extent_.sizes().x() / kColumn);
    columns_y_ = 1 + static_cast<int>(extent_.sizes().y() / kColumn);
    columns_.resize(static_cast<std::size_t>(columns_x_) * static_cast<std::size_t>(columns_y_));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      Eigen::AlignedBox2d footprint;
      for (const auto v : mesh.triangles[t]) footprint.extend(Vector2d(vertex(mesh, v).head<2>()));
      for (int y = row(footprint.min().y()); y <= row(footprint.max().y()); ++y) {
        for (int x = column(footprint.min().x()); x <= column(footprint.max().x()); ++x) at(x, y).push_back(t);
      }
    }
  }

  bool outside(const Vector3d& p) const {
    if (!extent_.contains(p.head<2>())) return true;
    int solids = 0;
    for (const auto t : columns_[index(column(p.x()), row(p.y()))]) solids += crossing(mesh_.triangles[t], p);
    return solids == 0;
  }

 private:
  static constexpr double kColumn = 0.75;

  int column(double x) const { return std::clamp(int((x - extent_.min().x()) / kColumn), 0, columns_x_ - 1); }
  int row(double y) const { return std::clamp(int((y - extent_.min().y()) / kColumn), 0, columns_y_ - 1); }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * columns_x_ + x); }
  std::vector<std::uint32_t>& at(int x, int y) { return columns_[index(x, y)]; }

  /// 1 if the ray up from p leaves a solid through this triangle, -1 if it enters one, 0 if it misses the triangle.
  int crossing(const std::array<std::uint32_t, 3>& triangle, const Vector3d& p) const {
    const Vector3d a = vertex(mesh_, triangle[0]), b = vertex(mesh_, triangle[1]), c = vertex(mesh_, triangle[2]);
    if (std::max({a.z(), b.z(), c.z()}) <= p.z()) return 0;
    const bool under = passes_left_of(a, b, p) ^ passes_left_of(b, c, p) ^ passes_left_of(c, a, p);
    if (!under) return 0;
    const Vector3d n = (b - a).cross(c - a);
    const double above = n.dot(a - p);  // n.z times the height of the plane above p
    if (n.z() > 0.0) return above > 0.0 ? 1 : 0;
    return n.z() < 0.0 && above < 0.0 ? -1 : 0;
  }

  /// Whether an edge, seen from above, crosses the line from p towards +x. The result is the same for both triangles of
  /// an edge, since the order of its ends does not matter: so a ray never passes between two triangles.
  static bool passes_left_of(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
    if ((a.y() > p.y()) == (b.y() > p.y())) return false;
    const Vector3d& low = a.y() < b.y() ? a : b;
    const Vector3d& high = a.y() < b.y() ? b : a;
    return p.x() < low.x() + (p.y() - low.y()) / (high.y() - low.y()) * (high.x() - low.x());
  }

  const TriangleMesh& mesh_;
  Eigen::AlignedBox2d extent_;
  int columns_x_ = 0, columns_y_ = 0;
  std::vector<std::vector<std::uint32_t>> columns_;
};

/// Determines whether a camera at some metres could see a point on a surface: along the normal, or obliquely. The rays
/// neither miss nor pass through thin members.
class ViewQuery {
 public:
  explicit ViewQuery(const TriangleMesh& mesh) : solids_(mesh), rays_(mesh) {}

  bool can_be_seen(const Vector3d& p, const Vector3d& n) const {
    const Vector3d from = p + kLift * n;
    if (p.z() < kLowest || !solids_.outside(from) || !free_way(from, n, kCovered)) return false;
    const Vector3d helper = std::abs(n.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
    const Vector3d u = helper.cross(n).normalized(), v = n.cross(u);
    for (const Vector3d& lean : {Vector3d(0, 0, 0), u, Vector3d(-u), v, Vector3d(-v)}) {
      const Vector3d direction = (n + kViewTilt * lean).normalized();
      const Vector3d camera = from + kFreeView * direction;
      if (camera.z() < kViewHeight || !free_way(from, direction, kFreeView)) continue;
      if (rays_.clearance(camera, kViewRoom) > kViewRoom) return true;
    }
    return false;
  }

 private:
  bool free_way(const Vector3d& from, const Vector3d& direction, double length) const {
    return !rays_.first_hit(from, direction, length, {.ground = false, .uavs = false});
  }

  SolidQuery solids_;
  RayScene rays_;
};

/// Visible points out of random points on the triangles, which are uniform over the area. In the order of drawing.
class Candidates {
 public:
  Candidates(const TriangleMesh& mesh, std::span<const OrientedBox> boxes, std::size_t wanted, std::uint64_t seed) {
    std::vector<double> area_up_to;
    double area = 0.0;
    for (const auto& t : mesh.triangles) {
      const Vector3d a = vertex(mesh, t[0]);
      area += 0.5 * (vertex(mesh, t[1]) - a).cross(vertex(mesh, t[2]) - a).norm();
      area_up_to.push_back(area);
    }
    if (area <= 0.0) return;
    const ViewQuery views(mesh);
    RandomStream random(seed, "surface_sampling", 0);
    std::size_t draws = 0;
    for (; draws < kDrawsPerCandidate * wanted && points.size() < wanted; ++draws) {
      const double where = random.uniform(0.0, area);
      const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end(), where);
      const auto& triangle =
          mesh.triangles[static_cast<std::size_t>(std::min(found, area_up_to.end() - 1) - area_up_to.begin())];
      const double root = std::sqrt(random.uniform()), share = random.uniform();
      const Vector3d a = vertex(mesh, triangle[0]), b = vertex(mesh, triangle[1]), c = vertex(mesh, triangle[2]);
      const Vector3d p = (1.0 - root) * a + root * (1.0 - share) * b + root * share * c;
      const Vector3d n = (b - a).cross(c - a).normalized();
      const auto holds = [&](const OrientedBox& box) { return box.contains(p); };
      if (std::any_of(boxes.begin(), boxes.end(), holds) && views.can_be_seen(p, n)) {
        points.push_back({p.cast<float>(), n.cast<float>()});
      }
    }
    visible_area = area * static_cast<double>(points.size()) / static_cast<double>(draws);
  }

  std::vector<InterestPoint> points;
  double visible_area = 0.0;
};

/// Accepted points in grid cells, to find neighbours.
class Neighbours {
 public:
  Neighbours(const Eigen::AlignedBox3f& extent, double cell) : cell_(cell), extent_(extent) {
    size_ = (extent_.sizes().cast<double>() / cell).cast<int>() + Eigen::Vector3i::Ones();
    cells_.resize(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()) *
                  static_cast<std::size_t>(size_.z()));
  }

  /// Whether an accepted point is within a radius. Points on the far side of a thin wall or member do not count.
  /// @param radius  at most the edge of a cell.
  bool any_within(const InterestPoint& point, double radius) const {
    const Eigen::Vector3i at = cell_of(point.p_W);
    const Eigen::Vector3i low = (at.array() - 1).max(0), high = (at.array() + 1).min(size_.array() - 1);
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          for (const InterestPoint& other : cells_[index({x, y, z})]) {
            const bool back_to_back = point.n_W.dot(other.n_W) < -0.5f;
            const double distance_sq = (point.p_W - other.p_W).cast<double>().squaredNorm();
            if (!back_to_back && distance_sq < radius * radius) return true;
          }
        }
      }
    }
    return false;
  }

  void add(const InterestPoint& point) { cells_[index(cell_of(point.p_W))].push_back(point); }

 private:
  Eigen::Vector3i cell_of(const Eigen::Vector3f& p) const {
    return ((p - extent_.min()).cast<double>() / cell_).cast<int>().cwiseMin(size_ - Eigen::Vector3i::Ones());
  }
  std::size_t index(const Eigen::Vector3i& c) const {
    return static_cast<std::size_t>((c.z() * size_.y() + c.y()) * size_.x() + c.x());
  }

  double cell_;
  Eigen::AlignedBox3f extent_;
  Eigen::Vector3i size_;
  std::vector<std::vector<InterestPoint>> cells_;
};

/// Sort key (Morton order) with which neighbouring places are mostly neighbours in the sorted list.
/// @param share  coordinates in [0, 1].
std::uint64_t place_in_order(const Vector3d& share) {
  constexpr int kBits = 10;
  std::uint64_t key = 0;
  for (int bit = kBits - 1; bit >= 0; --bit) {
    for (const double s : share) key = 2 * key + (static_cast<std::uint64_t>(s * ((1 << kBits) - 1)) >> bit & 1);
  }
  return key;
}

/// Divides the candidates into regions, and returns the region of each candidate. All regions have the same number of
/// candidates, and so the same area.
std::vector<std::size_t> regions(const std::vector<InterestPoint>& candidates, const Eigen::AlignedBox3f& extent,
                                 std::size_t count) {
  const double edge = std::max(1e-9, static_cast<double>(extent.sizes().maxCoeff()));
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    order.emplace_back(place_in_order((candidates[i].p_W - extent.min()).cast<double>() / edge), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> region(candidates.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank) region[order[rank].second] = rank * count / order.size();
  return region;
}

}  // namespace

std::vector<InterestPoint> sample_surface(const TriangleMesh& mesh, std::span<const OrientedBox> boxes,
                                          std::size_t count, std::uint64_t seed) {
  // Dart throwing: accept candidates that keep a distance from all accepted ones, and reduce the distance a little
  // whenever no more fit. Thin members have room for more points than their area justifies, so each region has a quota.
  constexpr double kFirstDistance = 0.85, kShrink = 0.96, kLastDistance = 0.3;  // of the mean spacing
  constexpr std::size_t kPointsPerRegion = 20;
  std::vector<InterestPoint> chosen;
  const Candidates candidates(mesh, boxes, count * kCandidatesPerPoint, seed);
  if (candidates.points.empty()) return chosen;
  Eigen::AlignedBox3f extent;
  for (const InterestPoint& point : candidates.points) extent.extend(point.p_W);
  const std::size_t region_count = std::max<std::size_t>(1, count / kPointsPerRegion);
  const std::vector<std::size_t> region = regions(candidates.points, extent, region_count);
  std::vector<std::size_t> room(region_count);
  for (std::size_t i = 0; i < region_count; ++i) room[i] = (i + 1) * count / region_count - i * count / region_count;

  const double spacing = std::sqrt(candidates.visible_area / static_cast<double>(count));
  Neighbours neighbours(extent, kFirstDistance * spacing);
  for (double share = kFirstDistance; share > kLastDistance; share *= kShrink) {
    for (std::size_t i = 0; i < candidates.points.size(); ++i) {
      const InterestPoint& point = candidates.points[i];
      if (room[region[i]] == 0 || neighbours.any_within(point, share * spacing)) continue;
      neighbours.add(point);
      chosen.push_back(point);
      --room[region[i]];
    }
  }
  return chosen;
}

Scene sampled(UnsampledScene unsampled) {
  Scene& scene = unsampled.scene;
  scene.points = sample_surface(scene.mesh, scene.boxes, unsampled.point_count, unsampled.seed);
  return std::move(scene);
}

}  // namespace skein::sim
