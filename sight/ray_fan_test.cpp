// RayFan compared with a test of every triangle in double precision, with closed surfaces that no ray may leave, and
// between the two instruction sets.
#include "sight/ray_fan.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

using test::add_box;
using test::random_in_box;
using test::random_unit;

constexpr float kReach = 50.0F;
constexpr double kNowhere = std::numeric_limits<double>::infinity();

/// Directions, row by row.
struct Grid {
  std::vector<Eigen::Vector3f> directions;
  std::size_t columns = 1;
};

/// Evenly spaced in azimuth and elevation, then turned.   @param width, height  angles from first to last [rad].
Grid grid(int rows, int columns, double width, double height, const Matrix3d& R_WL) {
  Grid result{{}, static_cast<std::size_t>(columns)};
  for (int row = 0; row < rows; ++row) {
    const double elevation = height * (row / std::max(1.0, rows - 1.0) - 0.5);
    for (int column = 0; column < columns; ++column) {
      const double azimuth = width * (column / static_cast<double>(columns) - 0.5);
      const Vector3d d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                       std::sin(elevation));
      result.directions.push_back((R_WL * d).cast<float>());
    }
  }
  return result;
}

constexpr double kRound = 2.0 * std::numbers::pi;
Grid lidar_grid(const Matrix3d& R_WL) { return grid(16, 440, kRound, std::numbers::pi / 6.0, R_WL); }

Matrix3d random_turn(RandomStream& random) {
  const double angle = kRound * random.uniform();
  return Eigen::AngleAxisd(angle, random_unit(random)).toRotationMatrix();
}

/// A mesh with the searches of both instruction sets, which must agree to the last bit.
class Traced {
 public:
  explicit Traced(TriangleMesh mesh)
      : mesh_(std::move(mesh)), sse2_(mesh_, RayFan::Width::sse2), widest_(mesh_, RayFan::Width::widest) {}

  const TriangleMesh& mesh() const { return mesh_; }

  std::vector<std::uint32_t> triangles(const Eigen::Vector3f& origin, const Grid& rays, float reach = kReach) const {
    const std::vector<float> reaches(rays.directions.size(), reach);
    std::vector<std::uint32_t> result(rays.directions.size()), wide(rays.directions.size());
    sse2_.trace(origin, rays.directions, rays.columns, reaches, result);
    widest_.trace(origin, rays.directions, rays.columns, reaches, wide);
    EXPECT_EQ(result, wide) << "SSE2 and AVX2 differ";
    return result;
  }

  /// Distance at which a ray crosses the plane of the triangle that was found for it.
  double distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, std::uint32_t triangle) const {
    if (triangle == RayFan::kNothing) return kNowhere;
    const auto corner = [&](int k) -> Vector3d {
      return (mesh_.vertices[mesh_.triangles[triangle][static_cast<std::size_t>(k)]].cast<double>());
    };
    const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    return normal.dot(corner(0) - origin.cast<double>()) / normal.dot(direction.cast<double>());
  }

 private:
  TriangleMesh mesh_;
  RayFan sse2_, widest_;
};

struct Tally {
  int certain = 0, hits = 0;
};

/// Compares ray by ray.   @param edge  a ray closer than this to an edge may pass on either side of it.
Tally expect_like_brute_force(const Traced& traced, const Eigen::Vector3f& origin, const Grid& rays, double edge = 2e-5,
                              float reach = kReach) {
  const auto found = traced.triangles(origin, rays, reach);
  Tally tally;
  int wrong = 0;
  for (std::size_t i = 0; i < rays.directions.size(); ++i) {
    const test::TestRay ray{origin.cast<double>(), rays.directions[i].cast<double>()};
    const auto expected = test::brute_force_distance(traced.mesh(), ray, reach, edge);
    if (expected.near_edge) continue;
    ++tally.certain;
    tally.hits += std::isfinite(expected.distance);
    const double distance = traced.distance(origin, rays.directions[i], found[i]);
    const bool same = std::isinf(expected.distance) ? std::isinf(distance)
                                                    : std::abs(distance - expected.distance) <= expected.tolerance;
    if (same || ++wrong > 5) continue;
    ADD_FAILURE() << "ray " << i << " from " << origin.transpose() << ": " << distance << " instead of "
                  << expected.distance;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(tally.certain, static_cast<int>(rays.directions.size() * 9 / 10));
  return tally;
}

TEST(RayFan, ScansAgreeWithBruteForce) {
  RandomStream random(1, "ray_fan_test", 0, 0);
  int hits = 0;
  for (const std::size_t count : {1U, 3U, 30U, 300U}) {
    const Traced traced(test::random_triangles(count, count));
    for (int scan = 0; scan < 2; ++scan) {
      const Eigen::Vector3f origin = random_in_box(random, {-22.0, -22.0, -22.0}, {22.0, 22.0, 22.0}).cast<float>();
      hits += expect_like_brute_force(traced, origin, lidar_grid(random_turn(random))).hits;
    }
  }
  EXPECT_GT(hits, 5000);
}

TEST(RayFan, AnyListOfDirectionsAgreesWithBruteForce) {
  RandomStream random(2, "ray_fan_test", 0, 0);
  const Traced traced(test::random_triangles(200, 5));
  for (const std::size_t columns : {1U, 7U, 8U, 80U, 560U}) {
    Grid rays{{}, columns};
    for (int i = 0; i < 560; ++i) rays.directions.push_back(random_unit(random).cast<float>());
    expect_like_brute_force(traced, {1.0F, -2.0F, 3.0F}, rays);
  }
  // Rows and columns in both directions, few rows, narrow and very narrow fans, one ray, none.
  const Matrix3d turn = random_turn(random);
  for (const auto& [rows, columns, width, height] : {std::tuple{16, 40, -0.5, 0.5},
                                                     {16, 40, 0.5, -0.5},
                                                     {33, 19, -1.0, -1.5},
                                                     {1, 440, kRound, 0.0},
                                                     {440, 1, 0.0, 3.0},
                                                     {5, 9, 1e-3, 1e-3},
                                                     {16, 8, 1e-9, 0.0},
                                                     {2, 2, 3.1, 3.1},
                                                     {1, 1, 0.0, 0.0}}) {
    expect_like_brute_force(traced, {1.0F, -2.0F, 3.0F}, grid(rows, columns, width, height, turn));
  }
  EXPECT_TRUE(traced.triangles({}, Grid{}).empty());
}

/// Bars of 2 cm in all directions, before a wall.
TriangleMesh lattice(RandomStream& random) {
  TriangleMesh mesh;
  for (int bar = 0; bar < 16; ++bar) {
    const Vector3d centre = random_in_box(random, {5.0, -4.0, -4.0}, {45.0, 4.0, 4.0});
    add_box(mesh, centre, {0.02, 0.02, 10.0}, random_turn(random));
  }
  add_box(mesh, {49.0, 0.0, 0.0}, {0.5, 200.0, 200.0});
  return mesh;
}

TEST(RayFan, ThinMembersAreNeitherMissedNorSeenThrough) {
  RandomStream random(3, "ray_fan_test", 0, 0);
  const Traced traced(lattice(random));
  const auto count_bars = [&traced](const std::vector<std::uint32_t>& found) {
    return std::ranges::count_if(found, [&](std::uint32_t t) { return t + 12 < traced.mesh().triangles.size(); });
  };
  std::ptrdiff_t on_bars = 0;
  for (int scan = 0; scan < 3; ++scan) {
    const Eigen::Vector3f origin = random_in_box(random, {-1.0, -2.0, -2.0}, {1.0, 2.0, 2.0}).cast<float>();
    const Grid rays = lidar_grid(test::rotation(kRound * random.uniform(), 0.0, 0.1));
    expect_like_brute_force(traced, origin, rays);
    on_bars += count_bars(traced.triangles(origin, rays));
    const Grid dense = grid(48, 96, 0.5, 0.5, test::rotation(0.3, 0.1 * scan, 0.0));
    expect_like_brute_force(traced, origin, dense);
    on_bars += count_bars(traced.triangles(origin, dense));
  }
  EXPECT_GT(on_bars, 200);
}

/// Rays that are aimed at the axis of a bar meet it, however far.
TEST(RayFan, AimedRaysMeetThinBars) {
  RandomStream random(4, "ray_fan_test", 0, 0);
  for (int bar = 0; bar < 40; ++bar) {
    TriangleMesh mesh;
    const Vector3d centre = random_in_box(random, {-60.0, -60.0, 20.0}, {60.0, 60.0, 60.0});
    const Matrix3d turn = random_turn(random);
    add_box(mesh, centre, {0.02, 0.02, 12.0}, turn);
    add_box(mesh, centre, {300.0, 300.0, 300.0});
    const Traced traced(mesh);
    const Vector3d axis = turn.col(2), across = axis.unitOrthogonal();
    for (const double far : {5.0, 20.0, 49.0}) {
      const Eigen::Vector3f origin = (centre + far * across).cast<float>();
      Grid rays{{}, 1};
      for (int i = 0; i <= 40; ++i) {
        const Vector3d target = centre + (0.29 * i - 5.8) * axis;
        rays.directions.push_back((target - origin.cast<double>()).normalized().cast<float>());
      }
      for (const std::uint32_t triangle : traced.triangles(origin, rays)) EXPECT_LT(triangle, 12U);
    }
  }
}

/// A sphere of 20 * 4^levels triangles about the origin.
TriangleMesh icosphere(int levels, double radius) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vector3d> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  TriangleMesh mesh;
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, added] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (added) points.push_back(points[a].normalized() + points[b].normalized());
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) finer.push_back(t);
    }
    mesh.triangles = finer;
  }
  for (const Vector3d& p : points) mesh.vertices.push_back((radius * p.normalized()).cast<float>());
  return mesh;
}

/// Rays from inside to all corners, to places on all edges and in random directions: each must hit the surface.
void expect_closed(const TriangleMesh& mesh, const Vector3d& low, const Vector3d& high, RandomStream& random) {
  const Traced traced(mesh);
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3f origin =
        k == 0 ? Eigen::Vector3f(0.5F * (low + high).cast<float>()) : random_in_box(random, low, high).cast<float>();
    Grid aimed{{}, 1};
    const auto aim = [&](const Vector3d& p) {
      aimed.directions.push_back((p - origin.cast<double>()).normalized().cast<float>());
    };
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 1 + mesh.triangles.size() / 400) {
      for (std::size_t side = 0; side < 3; ++side) {
        const Vector3d a = mesh.vertices[mesh.triangles[i][side]].cast<double>();
        const Vector3d b = mesh.vertices[mesh.triangles[i][(side + 1) % 3]].cast<double>();
        for (const double share : {0.0, 0.5, random.uniform()}) aim(a + share * (b - a));
      }
    }
    for (int i = 0; i < 500; ++i) aim(origin.cast<double>() + random_unit(random));
    for (const Grid& rays : {aimed, lidar_grid(random_turn(random)), lidar_grid(Matrix3d::Identity())}) {
      const auto found = traced.triangles(origin, rays, 1e4F);
      EXPECT_EQ(std::ranges::count(found, RayFan::kNothing), 0) << "from " << origin.transpose();
    }
  }
}

TEST(RayFan, NoRayLeavesAClosedSurface) {
  RandomStream random(5, "ray_fan_test", 0, 0);
  const Vector3d inside{1.0, 1.0, 1.0};
  for (const int levels : {0, 2, 4}) expect_closed(icosphere(levels, 3.0), -inside, inside, random);
  for (const double size : {3.0, 30.0, 3000.0}) {
    TriangleMesh box;
    add_box(box, {0.3 * size, -size, 0.1 * size}, {size, size, 0.5 * size});
    const Vector3d centre{0.3 * size, -size, 0.1 * size}, room = 0.2 * size * Vector3d::Ones();
    expect_closed(box, centre - room, centre + room, random);
    TriangleMesh turned;
    add_box(turned, centre, {size, size, 0.5 * size}, random_turn(random));
    expect_closed(turned, centre - 0.5 * room, centre + 0.5 * room, random);
  }
}

TEST(RayFan, NoRayPassesAFineSurfaceFromClose) {
  RandomStream random(6, "ray_fan_test", 0, 0);
  TriangleMesh sphere = icosphere(4, 30.0);
  for (auto& vertex : sphere.vertices) vertex += Eigen::Vector3f(80.0F, -50.0F, 35.0F);
  expect_closed(sphere, {80.0, -50.0, 35.0}, {105.0, -45.0, 45.0}, random);
}

TEST(RayFan, RaysHitNothingInAnEmptyWorld) {
  const Matrix3d turn = Matrix3d::Identity();
  TriangleMesh degenerate;  // a point, a line, twice the same corner; and corners that no triangle uses
  degenerate.vertices = {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}, {5, 1, 0}, {5, -1, 0.5}};
  degenerate.triangles = {{0, 0, 0}, {0, 1, 2}, {0, 3, 3}};
  for (const TriangleMesh& mesh : {TriangleMesh{}, degenerate}) {
    const auto found = Traced(mesh).triangles({0.0F, 0.0F, 0.0F}, lidar_grid(turn));
    EXPECT_EQ(std::ranges::count(found, RayFan::kNothing), 16 * 440);
  }
  // They must not affect a valid triangle beside them.
  degenerate.triangles.push_back({0, 3, 4});
  EXPECT_GT(expect_like_brute_force(Traced(degenerate), {0.0F, 0.1F, 0.1F}, lidar_grid(turn)).hits, 10);
}

TEST(RayFan, RaysEndAtTheirReach) {
  TriangleMesh mesh;
  add_box(mesh, {10.0, 0.0, 0.0}, {2.0, 200.0, 200.0});
  const Traced traced(mesh);
  const Grid rays{{Eigen::Vector3f::UnitX()}, 1};
  EXPECT_EQ(traced.triangles({0.0F, 0.3F, 0.1F}, rays, 8.999F).front(), RayFan::kNothing);
  EXPECT_NE(traced.triangles({0.0F, 0.3F, 0.1F}, rays, 9.001F).front(), RayFan::kNothing);
  EXPECT_NE(traced.triangles({0.0F, 0.3F, 0.1F}, rays, std::numeric_limits<float>::infinity()).front(),
            RayFan::kNothing);
}

/// The triangles that are not met at p itself.
TriangleMesh without_what_touches(const TriangleMesh& mesh, const Vector3d& p) {
  TriangleMesh apart = mesh;
  std::erase_if(apart.triangles, [&](const auto& triangle) {
    return test::brute_force_clearance({mesh.vertices, {triangle}}, p) < 1e-6;
  });
  return apart;
}

TEST(RayFan, ARayMayBeginOnTheSurface) {
  RandomStream random(7, "ray_fan_test", 0, 0);
  TriangleMesh mesh;
  add_box(mesh, {0.0, 0.0, 2.0}, {4.0, 4.0, 4.0});
  add_box(mesh, {7.0, 0.0, 2.0}, {1.0, 8.0, 8.0});
  const Traced traced(mesh);
  int judged = 0;
  // On a face, on an edge, on a corner, and beside faces in their plane.
  for (const Eigen::Vector3f& origin :
       {Eigen::Vector3f(2.0F, 0.3F, 1.1F), {2.0F, 2.0F, 1.0F}, {2.0F, 2.0F, 4.0F}, {2.0F, 3.0F, 1.0F}}) {
    const TriangleMesh apart = without_what_touches(mesh, origin.cast<double>());
    for (int scan = 0; scan < 3; ++scan) {
      const auto rays = lidar_grid(scan == 0 ? Matrix3d::Identity() : random_turn(random));
      const auto found = traced.triangles(origin, rays);
      for (std::size_t i = 0; i < found.size(); ++i) {
        const test::TestRay ray{origin.cast<double>(), rays.directions[i].cast<double>()};
        const auto expected = test::brute_force_distance(apart, ray, kReach, 2e-5);
        const double distance = traced.distance(origin, rays.directions[i], found[i]);
        // A ray may hit or miss a triangle that touches the origin. All triangles behind that are found as before.
        if (expected.near_edge || std::abs(distance) < 1e-4) continue;
        ++judged;
        EXPECT_TRUE(distance == expected.distance || std::abs(distance - expected.distance) <= expected.tolerance)
            << "ray " << i << " from " << origin.transpose() << ": " << distance << " " << expected.distance;
      }
    }
  }
  EXPECT_GT(judged, 20000);
}

TEST(RayFan, AgreesWithBruteForceFarFromTheWorldsOrigin) {
  RandomStream random(8, "ray_fan_test", 0, 0);
  for (const float shift : {1e3F, 1e5F, 1e6F}) {
    TriangleMesh mesh = test::random_triangles(100, 11);
    for (auto& vertex : mesh.vertices) vertex += Eigen::Vector3f(shift, -shift, 0.5F * shift);
    const Eigen::Vector3f origin(shift + 1.0F, -shift - 2.0F, 0.5F * shift + 3.0F);
    expect_like_brute_force(Traced(mesh), origin, lidar_grid(random_turn(random)));
  }
  for (const float scale : {1e-2F, 1e3F, 1e5F}) {
    TriangleMesh mesh = test::random_triangles(100, 12);
    for (auto& vertex : mesh.vertices) vertex *= scale;
    const Eigen::Vector3f origin = scale * Eigen::Vector3f(1.0F, 2.0F, 3.0F);
    expect_like_brute_force(Traced(mesh), origin, lidar_grid(random_turn(random)), 2e-5 * scale, kReach * scale);
  }
}

/// Infinite and NaN vertices must not affect other triangles.
TEST(RayFan, VerticesThatAreNoNumbersDoNotAffectOtherTriangles) {
  TriangleMesh mesh = test::random_triangles(60, 14), spoilt = mesh;
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  for (const float x : {nan, infinity, -infinity, 1e30F}) spoilt.vertices.push_back({x, 1.0F, -x});
  for (std::uint32_t i = 0; i < 4; ++i) spoilt.triangles.push_back({0, base + i, 1});
  const Grid rays = lidar_grid(Matrix3d::Identity());
  EXPECT_EQ(Traced(spoilt).triangles({1.0F, 2.0F, 3.0F}, rays), Traced(mesh).triangles({1.0F, 2.0F, 3.0F}, rays));
}

/// The triangles have the same centre, so the search tree cannot be divided by centres.
TEST(RayFan, TrianglesWithOneCommonCentreAgreeWithBruteForce) {
  RandomStream random(9, "ray_fan_test", 0, 0);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Eigen::Vector3f a = random_unit(random).cast<float>(), b = random_unit(random).cast<float>();
    for (const Eigen::Vector3f& corner : {a, b, Eigen::Vector3f(-a - b)}) mesh.vertices.push_back(corner);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  for (int i = 0; i < 200; ++i) mesh.triangles.push_back(mesh.triangles.front());
  expect_like_brute_force(Traced(mesh), {0.1F, 3.0F, 0.2F}, grid(16, 100, 1.0, 1.0, test::rotation(0.0, 0.0, -1.5)));
}

TEST(RayFan, AgreesWithBruteForceOnMbs) {
  const auto mbs = test::official_mesh("mbs/mbs.stl");
  if (!mbs) {
    GTEST_SKIP() << "SKEIN_ASSETS is not set";
  }
  const Traced traced(test::every_nth_triangle(*mbs, 40));
  RandomStream random(10, "ray_fan_test", 0, 0);
  const Eigen::Vector3f origin = random_in_box(random, {10.0, -10.0, 10.0}, {40.0, 10.0, 40.0}).cast<float>();
  EXPECT_GT(expect_like_brute_force(traced, origin, grid(16, 110, kRound, 0.5, random_turn(random))).hits, 20);
}

}  // namespace
}  // namespace skein::sim
