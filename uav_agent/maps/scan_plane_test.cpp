// The plane of a frame from its hits alone: found where it can be, never a wrong one.
#include "uav_agent/maps/scan_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Vector3d random_direction(RandomStream& random) {
  const double z = random.uniform(-1.0, 1.0), heading = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(heading), r * std::sin(heading), z};
}

/// 16 rings about a plane; what they meet of the ground and of some walls, thinned out.
std::vector<Eigen::Vector3f> frame(const Vector3d& p_WS, const Vector3d& normal, RandomStream& random) {
  struct Wall {
    Vector3d normal;
    double distance, half_width;
  };
  std::vector<Wall> walls;
  for (double more = random.uniform(0.0, 4.0); more > 1.0; more -= 1.0) {
    const double heading = random.uniform(-std::numbers::pi, std::numbers::pi);
    walls.push_back(
        {{std::cos(heading), std::sin(heading), 0.0}, random.uniform(4.0, 25.0), random.uniform(2.0, 20.0)});
  }
  const Vector3d a = normal.unitOrthogonal(), b = normal.cross(a);
  std::vector<Eigen::Vector3f> hits;
  for (int ring = 0; ring < 16; ++ring) {
    const double lift = (-15.0 + 2.0 * ring) * kDegree;
    for (int column = 0; column < 360; ++column) {
      const double turn = column * kDegree;
      const Vector3d ray = std::cos(lift) * (std::cos(turn) * a + std::sin(turn) * b) + std::sin(lift) * normal;
      double distance = ray.z() < 0.0 ? -p_WS.z() / ray.z() : 1e9;
      for (const Wall& wall : walls) {
        const double s = wall.distance / ray.dot(wall.normal);
        const Vector3d along = Vector3d::UnitZ().cross(wall.normal);
        if (s > 0.0 && s < distance && std::abs(s * ray.dot(along)) < wall.half_width && s * ray.z() < 15.0)
          distance = s;
      }
      if (distance < 50.0 && random.uniform() < 0.2) hits.push_back((p_WS + distance * ray).cast<float>());
    }
  }
  return hits;
}

TEST(ScanPlane, IsFoundOrNotButNeverWrong) {
  int found = 0, frames = 0;
  for (std::uint64_t world = 0; world < 400; ++world) {
    RandomStream random(world, "scan_plane_test", 0);
    const Vector3d normal = random_direction(random), p_WS(0, 0, random.uniform(0.4, 40.0));
    const auto told = scan_plane(p_WS, frame(p_WS, normal, random));
    ++frames;
    if (!told) continue;
    ++found;
    EXPECT_GT(std::abs(told->dot(normal)), std::cos(6.0 * kDegree))
        << world << ": as sure as kSurelyLookedSine takes it";
  }
  EXPECT_GT(found, frames / 2);
}

TEST(ScanPlane, HitsOnOneSideTellNothing) {
  RandomStream random(1, "one_side", 0);
  std::vector<Eigen::Vector3f> hits;
  for (int i = 0; i < 500; ++i) {
    hits.push_back(Vector3d(10.0, random.uniform(-2.0, 2.0), 5.0 + random.uniform(-2.0, 2.0)).cast<float>());
  }
  EXPECT_FALSE(scan_plane({0, 0, 5}, hits));
  EXPECT_FALSE(scan_plane({0, 0, 5}, {}));
}

}  // namespace
}  // namespace skein::agent
