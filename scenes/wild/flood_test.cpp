// Checks what is_flyable() promises of a world. The test is an independent second implementation: it uses neither rays
// nor a map, but a grid of cells of 0.3 m, filled from above. It checks necessary conditions only: not, for example,
// whether views are open.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/scenario/drawn_worlds.hpp"
#include "core/scoring/camera_quality.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/wild/flyable.hpp"
#include "scenes/wild/world.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_program.hpp"

namespace skein::sim {
namespace {

constexpr double kCell = 0.3, kMargin = 8.0;
/// Least distance between a cell's middle and a sample of the surface [m]. The proof requires 1.4 m along lines 1 m
/// apart: 0.9 m are left half way between two lines, and 0.26 m less at the middle of the cell there. A body of 0.63 m
/// still fits.
constexpr double kBerth = 0.64;

class Flood {
 public:
  explicit Flood(const TriangleMesh& mesh) {
    for (const auto& vertex : mesh.vertices) box_.extend(vertex.cast<double>());
    box_.min() -= Vector3d(kMargin, kMargin, 0.0);
    box_.max() += Vector3d::Constant(kMargin);
    box_.min().z() = 0.0;
    for (int axis = 0; axis < 3; ++axis) size_[axis] = static_cast<int>(box_.sizes()[axis] / kCell) + 1;
    cells_.assign(static_cast<std::size_t>(size_.prod()), Cell::open);
    for (const auto& t : mesh.triangles) block_triangle(mesh, t);
    for (int x = 0; x < size_.x(); ++x) {
      for (int y = 0; y < size_.y(); ++y) {
        for (int z = 0; middle({x, y, z}).z() < 0.5; ++z) at({x, y, z}) = Cell::blocked;
      }
    }
    fill(size_ - Eigen::Vector3i::Ones());  // a corner of the sky
  }

  /// Whether the flood from the sky has reached a cell whose middle is that near. Beyond the grid, everything is sky.
  bool reaches(const Vector3d& p, double distance) const {
    if (!box_.contains(p)) return p.z() > 0.0;
    bool reached = false;
    visit_near(p, distance, [&](const Eigen::Vector3i& cell) { reached = reached || at(cell) == Cell::reached; });
    return reached;
  }

 private:
  enum class Cell : std::uint8_t { open, blocked, reached };

  Vector3d middle(const Eigen::Vector3i& c) const {
    return box_.min() + kCell * (c.cast<double>() + Vector3d::Constant(0.5));
  }
  Eigen::Vector3i cell_of(const Vector3d& p) const {
    const Eigen::Vector3i c = ((p - box_.min()) / kCell).array().floor().cast<int>();
    return c.cwiseMax(0).cwiseMin(size_ - Eigen::Vector3i::Ones());
  }
  std::size_t index(const Eigen::Vector3i& c) const {
    return (static_cast<std::size_t>(c.x()) * size_.y() + c.y()) * size_.z() + c.z();
  }
  Cell& at(const Eigen::Vector3i& c) { return cells_[index(c)]; }
  Cell at(const Eigen::Vector3i& c) const { return cells_[index(c)]; }

  void block_triangle(const TriangleMesh& mesh, const auto& t) {
    const auto corner = [&](std::size_t i) { return Vector3d(mesh.vertices[t[i]].template cast<double>()); };
    const Vector3d a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
    const double longest = std::max({ab.norm(), ac.norm(), (ab - ac).norm()});
    const int n = static_cast<int>(std::ceil(longest / kCell)) + 1;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) block_around(a + ab * i / n + ac * j / n);
    }
  }
  void block_around(const Vector3d& p) {
    visit_near(p, kBerth, [this](const Eigen::Vector3i& cell) { at(cell) = Cell::blocked; });
  }
  /// The cells whose middles are at most that far away.
  void visit_near(const Vector3d& p, double distance, const auto& visit) const {
    const Eigen::Vector3i low = cell_of(p - Vector3d::Constant(distance)),
                          high = cell_of(p + Vector3d::Constant(distance));
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int z = low.z(); z <= high.z(); ++z) {
          const Eigen::Vector3i cell(x, y, z);
          if ((middle(cell) - p).squaredNorm() <= distance * distance) visit(cell);
        }
      }
    }
  }
  void fill(const Eigen::Vector3i& from) {
    std::vector<Eigen::Vector3i> edge = {from};
    at(from) = Cell::reached;
    while (!edge.empty()) {
      const Eigen::Vector3i here = edge.back();
      edge.pop_back();
      for (int k = 0; k < 6; ++k) {
        Eigen::Vector3i next = here;
        next[k / 2] += k % 2 == 0 ? 1 : -1;
        if ((next.array() < 0).any() || (next.array() >= size_.array()).any() || at(next) != Cell::open) continue;
        at(next) = Cell::reached;
        edge.push_back(next);
      }
    }
  }

  Eigen::AlignedBox3d box_;
  Eigen::Vector3i size_;
  std::vector<Cell> cells_;
};

Vector3d above(const Vector2d& start) { return {start.x(), start.y(), 1.5}; }
/// A clear takeoff may pass closer to a surface than kBerth; within this distance, there is room again. It is less than
/// the thickness of the walls below plus the berth on both sides.
constexpr double kFromStart = 1.3;

class FloodedWorld : public testing::TestWithParam<std::string> {
 protected:
  /// The seed is different at each commit.
  const World world_ = draw_world(GetParam(), 100 + turn_number() % 50, source_path("config"));
};

TEST_P(FloodedWorld, StartsStationAndPointsAreConnectedToTheSky) {
  const Flood flood(world_.scene.mesh);
  for (const UavConfig& uav : world_.scenario.fleet)
    EXPECT_TRUE(flood.reaches(above(uav.start), kFromStart)) << uav.name;
  EXPECT_TRUE(flood.reaches(world_.scenario.station_position + Vector3d(0, 0, 3), 36.0));
  const double farthest =
      0.85 * resolution_distance(world_.scenario.fleet.front().vehicle.camera, world_.scenario.desired_mm_per_pixel);
  std::size_t near = 0;
  for (const InterestPoint& point : world_.scene.points) {
    const Vector3d ahead = point.p_W.cast<double>() + 0.5 * farthest * point.n_W.cast<double>();
    near += flood.reaches(ahead, 0.7 * farthest);
  }
  EXPECT_GE(static_cast<double>(near), 0.25 * static_cast<double>(world_.scene.points.size()));
}

TEST_P(FloodedWorld, AWalledInStartIsNotConnectedToTheSky) {
  MeshBuilder walls;
  const Vector2d start = world_.scenario.fleet.front().start;
  for (int i = 0; i < 4; ++i) {
    const Isometry3d X_WS = standing_at(start, 1.5707963267948966 * i);
    walls.add_box(X_WS * Eigen::Translation3d(1.9, 0, 3.0), {0.4, 4.6, 7.0});
  }
  walls.add_box(standing_at(start, 0.0) * Eigen::Translation3d(0, 0, 6.0), {4.6, 4.6, 0.4});
  TriangleMesh mesh = world_.scene.mesh;
  append(mesh, walls.mesh());
  EXPECT_FALSE(Flood(mesh).reaches(above(start), kFromStart));
}

INSTANTIATE_TEST_SUITE_P(Wild, FloodedWorld,
                         testing::ValuesIn(std::vector<std::string>(kWildWorlds.begin(), kWildWorlds.end())),
                         [](const auto& family) { return family.param; });

}  // namespace
}  // namespace skein::sim
