// RayScene compared with a brute-force intersection in double precision, and with what geometry says of thin members.
#include "sight/ray_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "core/math/random_stream.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

using test::add_box;
using test::brute_force_distance;
using test::random_in_box;
using test::random_unit;
using test::rotation;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RayFilter structure_only() { return {.ground = false, .uavs = false}; }

double distance_of(const RayScene& world, const test::TestRay& ray, double distance_max) {
  const auto hit = world.first_hit(ray.origin, ray.direction, distance_max, structure_only());
  return hit ? hit->distance : kInfinity;
}

/// Compares on many rays, single and in scans. A ray within `kEdge` of an edge may pass on either side of it.
void expect_nearest_of_all(const TriangleMesh& mesh, const Vector3d& low, const Vector3d& high, int rays) {
  const RayScene world(mesh);
  RandomStream random(1, "ray_scene_test", 0, 0);
  constexpr double kReach = 80.0, kEdge = 2e-5;
  int hits = 0, certain = 0;
  for (int i = 0; i < rays; ++i) {
    const test::TestRay ray{random_in_box(random, low, high), random_unit(random)};
    const auto expected = brute_force_distance(mesh, ray, kReach, kEdge);
    const double single = distance_of(world, ray, kReach);
    const Eigen::Vector3f direction = ray.direction.cast<float>();
    double scanned = 0.0;
    world.scan(ray.origin, std::span(&direction, 1), 1, kReach, structure_only(), std::span(&scanned, 1));
    if (expected.near_edge) {
      continue;
    }
    ++certain;
    hits += std::isfinite(expected.distance);
    for (const double found : {single, scanned}) {
      if (std::isinf(expected.distance)) {
        EXPECT_TRUE(std::isinf(found)) << "ray " << i << " found " << found;
      } else {
        EXPECT_NEAR(found, expected.distance, expected.tolerance) << "ray " << i;
      }
    }
  }
  EXPECT_GT(certain, rays * 9 / 10);
  EXPECT_GT(hits, rays / 20);
}

TEST(RayScene, AgreesWithBruteForceOnAGeneratedMesh) {
  const TriangleMesh mesh = test::random_triangles(2000, 7);
  expect_nearest_of_all(mesh, {-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0}, 2500);
}

TEST(RayScene, AgreesWithBruteForceOnMbs) {
  const auto mbs = test::official_mesh("mbs/mbs.stl");
  if (!mbs) {
    GTEST_SKIP() << "SKEIN_ASSETS is not set";
  }
  const TriangleMesh part = test::every_nth_triangle(*mbs, 16);
  expect_nearest_of_all(part, {-20.0, -40.0, 0.0}, {90.0, 40.0, 60.0}, 1200);
}

TEST(RayScene, EmptyWorldHasOnlyGround) {
  const RayScene world(TriangleMesh{});
  const auto hit = world.first_hit({1.0, 2.0, 3.0}, {0.0, 0.6, -0.8}, 100.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->kind, HitKind::ground);
  EXPECT_NEAR(hit->distance, 3.0 / 0.8, 1e-12);
  EXPECT_FALSE(world.first_hit({1.0, 2.0, 3.0}, {0.0, 0.6, -0.8}, 3.7));
  EXPECT_FALSE(world.first_hit({1.0, 2.0, 3.0}, {0.0, 0.6, -0.8}, 100.0, structure_only()));
  EXPECT_FALSE(world.first_hit({1.0, 2.0, 3.0}, {0.0, 0.6, 0.8}, 100.0));
  EXPECT_FALSE(world.first_hit({1.0, 2.0, 3.0}, Vector3d::Zero(), 100.0));
  EXPECT_TRUE(std::isinf(world.clearance({1.0, 2.0, 3.0})));
}

TEST(RayScene, RefusesTriangleWithoutVertex) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 3}};
  EXPECT_THROW(RayScene{mesh}, std::runtime_error);
}

TEST(RayScene, ASegmentMeetsNothingBeyondItsEnd) {
  TriangleMesh mesh;
  add_box(mesh, {10.0, 0.0, 10.0}, {1.0, 20.0, 20.0});
  const RayScene world(mesh);
  const Vector3d from{0.0, 0.3, 5.1};
  EXPECT_FALSE(world.first_hit_distance(from, {9.4, 0.3, 5.1}));
  const auto through = world.first_hit_distance(from, {20.0, 0.3, 5.1});
  ASSERT_TRUE(through);
  EXPECT_NEAR(*through, 9.5, 1e-6);
  EXPECT_FALSE(world.first_hit_distance(from, from));
}

/// A ray ends no later than at a triangle that surely blocks it. Most triangles that block a ray do so surely.
TEST(RayScene, ARayThatATriangleSurelyBlocksIsBlocked) {
  const TriangleMesh mesh = test::random_triangles(300, 13);
  const RayScene world(mesh);
  RandomStream random(7, "ray_scene_test", 0, 0);
  int blocked = 0, sure = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d from = random_in_box(random, {-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0});
    const Vector3d to = random_in_box(random, {-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0});
    const double length = (to - from).norm(), reach = length * random.uniform();
    for (std::uint32_t triangle = 0; triangle < 300; triangle += 7) {
      if (!world.surely_blocked_by(triangle, from, to, reach)) continue;
      const auto hit = world.first_hit(from, to - from, length, structure_only());
      ASSERT_TRUE(hit && hit->distance <= reach) << "triangle " << triangle << " ray " << i;
    }
    if (const auto hit = world.first_hit(from, to - from, length, structure_only())) {
      ++blocked;
      ASSERT_LT(hit->triangle, 300U);
      sure += world.surely_blocked_by(hit->triangle, from, to, length);
      EXPECT_FALSE(world.surely_blocked_by(hit->triangle, from, to, hit->distance));
    }
  }
  EXPECT_GT(blocked, 1000);
  EXPECT_GT(sure, blocked * 9 / 10);
  EXPECT_FALSE(world.surely_blocked_by(kNoTriangle, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.0));
}

/// A bar 2 cm thick, far away, at any angle: rays at its axis hit it, and nothing behind it is ever seen through it.
TEST(RayScene, AThinMemberIsNeitherMissedNorSeenThrough) {
  RandomStream random(2, "ray_scene_test", 0, 0);
  for (int bar = 0; bar < 40; ++bar) {
    TriangleMesh mesh;
    const Vector3d centre = random_in_box(random, {-60.0, -60.0, 20.0}, {60.0, 60.0, 60.0});
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(6.0 * random.uniform(), random_unit(random)));
    add_box(mesh, centre, {0.02, 0.02, 12.0}, turn.toRotationMatrix());
    const RayScene world(mesh);
    const Vector3d axis = turn * Vector3d::UnitZ();
    for (int i = 0; i < 200; ++i) {
      const Vector3d target = centre + (11.8 * random.uniform() - 5.9) * axis;
      const Vector3d across = random_unit(random).cross(axis);
      if (across.norm() < 0.3) {
        continue;
      }
      const Vector3d from = target + 45.0 * across.normalized();
      const double found = distance_of(world, {from, (target - from).normalized()}, 50.0);
      ASSERT_LT(found, 45.0 - 0.0099) << "bar " << bar << " ray " << i;
      ASSERT_GT(found, 45.0 - 0.0145) << "bar " << bar << " ray " << i;
    }
  }
}

/// Rays aimed exactly at the shared edges and corners of a closed box must not slip through.
TEST(RayScene, NoRayPassesBetweenTrianglesThatShareAnEdge) {
  TriangleMesh mesh;
  add_box(mesh, {30.0, 7.0, 20.0}, {6.0, 4.0, 2.0}, rotation(0.3, 0.2, 1.0));
  const RayScene world(mesh);
  RandomStream random(3, "ray_scene_test", 0, 0);
  for (const auto& triangle : mesh.triangles) {
    for (int side = 0; side < 3; ++side) {
      const Vector3d a = mesh.vertices[triangle[side]].cast<double>();
      const Vector3d b = mesh.vertices[triangle[(side + 1) % 3]].cast<double>();
      for (int i = 0; i < 300; ++i) {
        // The rays start inside the box. They must hit it, however coordinates are rounded.
        const Vector3d from = random_in_box(random, {29.7, 6.7, 19.8}, {30.3, 7.3, 20.2});
        const Vector3d target = a + random.uniform() * (b - a);
        ASSERT_NEAR(distance_of(world, {from, (target - from).normalized()}, 100.0), (target - from).norm(), 1e-4);
      }
    }
  }
}

TEST(RayScene, BodiesHideExceptTheExcludedOnes) {
  VehicleConfig vehicle;
  RayScene world(TriangleMesh{}, {body_shape(vehicle), body_shape(vehicle)});
  const Vector3d from{0.0, 0.0, 10.0}, to{20.0, 0.0, 10.0};
  EXPECT_FALSE(world.first_hit_distance(from, to)) << "a body hides nothing before it has a pose";
  world.set_pose(UavIndex{0}, Isometry3d(Eigen::Translation3d(5.0, 0.0, 10.0)));
  world.set_pose(UavIndex{1}, Isometry3d(Eigen::Translation3d(9.0, 0.0, 10.0)));
  auto hit = world.first_hit(from, to - from, 20.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->kind, HitKind::uav);
  EXPECT_EQ(hit->uav, 0U);
  EXPECT_NEAR(hit->distance, 4.9, 1e-12);
  hit = world.first_hit(from, to - from, 20.0, {.except_uav = UavIndex{0}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->uav, 1U);
  EXPECT_NEAR(hit->distance, 8.9, 1e-12);
  EXPECT_FALSE(world.first_hit(from, to - from, 20.0, {.except_uav = UavIndex{1}, .except_other_uav = UavIndex{0}}));
  EXPECT_FALSE(world.first_hit(from, to - from, 20.0, {.uavs = false}));
  EXPECT_FALSE(world.first_hit_distance(from, {4.8, 0.0, 10.0}));
}

TEST(RayScene, RotorDiscsTurnWithTheBody) {
  VehicleConfig vehicle;
  RayScene world(TriangleMesh{}, {body_shape(vehicle)});
  const Isometry3d X_WB = Eigen::Translation3d(3.0, -2.0, 8.0) * Eigen::Quaterniond(rotation(0.2, -0.3, 2.0));
  world.set_pose(UavIndex{0}, X_WB);
  for (int i = 0; i < 6; ++i) {
    const double angle = (30.0 + 60.0 * i) * std::numbers::pi / 180.0;
    const Vector3d hub{vehicle.arm_m * std::cos(angle), vehicle.arm_m * std::sin(angle), vehicle.rotor_height_m};
    const Vector3d start = X_WB * (hub + Vector3d(0.0, 0.0, 2.0));
    const Vector3d down = X_WB.linear() * -Vector3d::UnitZ();
    const auto hit = world.first_hit(start, down, 3.0, {.ground = false});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 2.0, 1e-9);
    const Vector3d outside = hub * ((vehicle.arm_m + 1.02 * vehicle.rotor_radius_m) / vehicle.arm_m);
    EXPECT_FALSE(world.first_hit(X_WB * (outside + Vector3d(0.0, 0.0, 2.0)), down, 3.0, {.ground = false}));
  }
}

TEST(RayScene, RaysHitABoxOfALinkAsTheyHitStructure) {
  RandomStream random(7, "ray_scene_test", 0, 0);
  int hits = 0;
  for (int i = 0; i < 50; ++i) {
    VehicleConfig vehicle;
    vehicle.rotor_radius_m = 0.0;
    vehicle.arm_m = 0.01;
    vehicle.collision_box_m = Vector3d::Constant(0.01);
    const Vector3d p_BL = random_in_box(random, {-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9});
    const Vector3d edges = random_in_box(random, {0.1, 0.1, 0.1}, {0.8, 0.8, 0.8});
    vehicle.links.push_back({.name = "box", .mass_kg = 0.1, .p_BL = p_BL, .box_m = edges});
    const Isometry3d X_WB = Eigen::Translation3d(0.0, 0.0, 9.0) *
                            Eigen::Quaterniond(rotation(random.uniform(), random.uniform(), 6.0 * random.uniform()));
    TriangleMesh mesh;
    test::add_box(mesh, X_WB * p_BL, edges, X_WB.linear());
    RayScene world(TriangleMesh{}, {body_shape(vehicle)});
    world.set_pose(UavIndex{0}, X_WB);
    for (int j = 0; j < 100; ++j) {
      const Vector3d from = Vector3d(0.0, 0.0, 9.0) + 3.0 * random_unit(random);
      const Vector3d to = X_WB * (p_BL + 0.7 * random_in_box(random, -edges, edges));
      const test::TestRay ray{from, (to - from).normalized()};
      const auto expected = test::brute_force_distance(mesh, ray, 10.0, 1e-4);
      const auto hit = world.first_hit(from, ray.direction, 10.0, {.ground = false});
      // The body itself, a centimetre wide, may be in front of the box.
      if (expected.near_edge || (hit && hit->distance < expected.distance - 1e-3 &&
                                 (from + hit->distance * ray.direction - X_WB.translation()).norm() < 0.02)) {
        continue;
      }
      ASSERT_EQ(hit.has_value(), std::isfinite(expected.distance));
      hits += hit.has_value();
      const double gap = hit ? hit->distance - expected.distance : 0.0;
      ASSERT_NEAR(gap, 0.0, 1e-3) << "the tolerance is for vertices in single precision";
      std::vector<double> scanned(1);
      world.scan(from, std::vector<Eigen::Vector3f>{ray.direction.cast<float>()}, 1, 10.0, {.ground = false}, scanned);
      ASSERT_TRUE(std::isinf(scanned[0]) == !hit || std::abs(scanned[0] - expected.distance) < 1e-2);
    }
  }
  EXPECT_GT(hits, 2000);
}

/// The scan's culling of bodies must not change what single rays see.
TEST(RayScene, ScanAgreesWithSingleRays) {
  TriangleMesh mesh = test::random_triangles(500, 3);
  VehicleConfig vehicle;
  RayScene world(mesh, std::vector<BodyShape>(6, body_shape(vehicle)));
  RandomStream random(4, "ray_scene_test", 0, 0);
  for (const UavIndex uav : FirstUavs(6)) {
    world.set_pose(uav, Eigen::Translation3d(random_in_box(random, {-3.0, -3.0, 1.0}, {3.0, 3.0, 5.0})) *
                            Eigen::Quaterniond(rotation(0.1, 0.1, 6.0 * random.uniform())));
  }
  const RayFilter filter{.except_uav = UavIndex{2}};
  int bodies = 0, grazing = 0;
  for (int scan = 0; scan < 10; ++scan) {
    const Vector3d origin = random_in_box(random, {-3.0, -3.0, 1.0}, {3.0, 3.0, 5.0});
    std::vector<Eigen::Vector3f> directions;
    for (int i = 0; i < 1000; ++i) {
      directions.push_back(random_unit(random).cast<float>());
    }
    std::vector<double> distances(directions.size());
    world.scan(origin, directions, directions.size(), 30.0, filter, distances);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const auto hit = world.first_hit(origin, directions[i].cast<double>(), 30.0, filter);
      bodies += hit && hit->kind == HitKind::uav;
      const bool same = hit ? std::abs(distances[i] - hit->distance) < 1e-3 : std::isinf(distances[i]);
      // A ray that grazes an edge may pass it on either side.
      const test::TestRay ray{origin, directions[i].cast<double>()};
      ASSERT_TRUE(same || test::brute_force_distance(mesh, ray, 30.0, 2e-5).near_edge)
          << distances[i] << " " << (hit ? hit->distance : kInfinity);
      grazing += !same;
    }
  }
  EXPECT_LE(grazing, 5);
  EXPECT_GT(bodies, 100);
}

TEST(RayScene, ClearanceAgreesWithBruteForce) {
  const TriangleMesh mesh = test::random_triangles(800, 5);
  const RayScene world(mesh);
  RandomStream random(5, "ray_scene_test", 0, 0);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = random_in_box(random, {-30.0, -30.0, -30.0}, {30.0, 30.0, 30.0});
    const double expected = test::brute_force_clearance(mesh, p);
    EXPECT_NEAR(world.clearance(p), expected, 1e-5);
    EXPECT_TRUE(std::isinf(world.clearance(p, 0.9 * expected)));
    EXPECT_NEAR(world.clearance(p, 1.1 * expected), expected, 1e-5);
  }
}

/// A scene that is built again gives the same bits. With the instruction set that Embree prefers, distances agree to a
/// micrometre.
TEST(RayScene, ARebuiltSceneGivesTheSameBits) {
  const TriangleMesh mesh = test::random_triangles(1500, 9);
  const RayScene first(mesh), second(mesh), native(mesh, {}, true);
  RandomStream random(6, "ray_scene_test", 0, 0);
  int differ = 0;
  for (int i = 0; i < 3000; ++i) {
    const test::TestRay ray{random_in_box(random, {-20.0, -20.0, -20.0}, {20.0, 20.0, 20.0}), random_unit(random)};
    const double a = distance_of(first, ray, 60.0);
    EXPECT_EQ(a, distance_of(second, ray, 60.0));
    differ += a != distance_of(native, ray, 60.0);
  }
  EXPECT_LE(differ, 3);
}

}  // namespace
}  // namespace skein::sim
