#include "sim_server/flight/physics_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/vehicle/airframe.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// A vertical wall of two triangles: x = `x`, 20 m wide, 20 m high.
TriangleMesh wall(float x) {
  TriangleMesh mesh;
  mesh.vertices = {{x, -10, 0}, {x, 10, 0}, {x, 10, 20}, {x, -10, 20}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A square bar, `width` thick, along y at height z.
TriangleMesh bar(float x, float z, float width) {
  const float h = width / 2;
  TriangleMesh mesh;
  for (const float y : {-5.0F, 5.0F}) {
    mesh.vertices.insert(mesh.vertices.end(),
                         {{x - h, y, z - h}, {x + h, y, z - h}, {x + h, y, z + h}, {x - h, y, z + h}});
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    mesh.triangles.push_back({i, j, i + 4});
    mesh.triangles.push_back({j, j + 4, i + 4});
  }
  return mesh;
}

Isometry3d at(double x, double y, double z) { return Isometry3d(Eigen::Translation3d(x, y, z)); }

VehicleConfig photographer() {
  VehicleConfig vehicle;
  vehicle.role = Role::photographer;
  vehicle.mass_kg = 1.545;
  vehicle.inertia = {0.034756, 0.045893, 0.0977};
  vehicle.arm_m = 0.2156;
  vehicle.rotor_radius_m = 0.1;
  vehicle.rotor_height_m = 0.037;
  vehicle.collision_box_m = {0.1, 0.1, 0.16};
  return vehicle;
}

TEST(PhysicsWorld, ABodyFallsFreely) {
  PhysicsWorld world({});
  world.add_uav({}, at(0, 0, 100));
  for (int i = 0; i < 400; ++i) world.tick();
  // Semi-implicit Euler: the velocity is exact, the height is half a tick's speed per second too low.
  EXPECT_NEAR(world.state(UavIndex{0}).v_WB.z(), -kWorldGravity, 1e-9);
  EXPECT_NEAR(world.state(UavIndex{0}).p_WB.z(), 100 - 0.5 * kWorldGravity * 1.0 * (1.0 + kTickS), 1e-9);
}

TEST(PhysicsWorld, WrenchesAddUpAndLastOneTick) {
  PhysicsWorld world({});
  const VehicleConfig vehicle;
  world.add_uav(vehicle, at(0, 0, 10));
  const Vector3d half_weight(0, 0, 0.5 * vehicle.mass_kg * kWorldGravity);
  world.apply_wrench(UavIndex{0}, half_weight, {0, 0, 0.1});
  world.apply_wrench(UavIndex{0}, half_weight, {0, 0, 0.1});
  world.tick();
  EXPECT_NEAR(world.state(UavIndex{0}).v_WB.norm(), 0.0, 1e-12);
  EXPECT_NEAR(world.state(UavIndex{0}).w_WB_B.z(), 0.2 / vehicle.inertia.z() * kTickS, 1e-9);
  world.tick();
  EXPECT_NEAR(world.state(UavIndex{0}).v_WB.z(), -kWorldGravity * kTickS, 1e-12);
}

TEST(PhysicsWorld, ASpinningBodyKeepsMomentumAndEnergy) {
  const VehicleConfig vehicle = photographer();  // three different moments of inertia
  PhysicsWorld world({});
  world.add_uav(vehicle, at(0, 0, 1000));
  const Vector3d w0(3.0, 2.0, -4.0);
  world.set_state(UavIndex{0}, {.p_WB = {0, 0, 1000}, .w_WB_B = w0});
  const auto momentum = [&] {
    return Vector3d(world.state(UavIndex{0}).q_WB * vehicle.inertia.cwiseProduct(world.state(UavIndex{0}).w_WB_B));
  };
  const auto energy = [&] {
    const Vector3d& w = world.state(UavIndex{0}).w_WB_B;
    return 0.5 * w.dot(vehicle.inertia.cwiseProduct(w));
  };
  const Vector3d L0 = momentum();
  const double E0 = energy();
  for (int i = 0; i < 4 * kTicksPerSecond; ++i) world.tick();
  EXPECT_NEAR((momentum() - L0).norm() / L0.norm(), 0.0, 1e-6);
  EXPECT_NEAR(energy() / E0, 1.0, 0.002);
  EXPECT_NEAR(world.state(UavIndex{0}).q_WB.norm(), 1.0, 1e-9);
}

TEST(PhysicsWorld, AUavRestsOnTheGroundWithoutCreeping) {
  for (const VehicleConfig& vehicle : {VehicleConfig{}, photographer()}) {
    PhysicsWorld world({});
    world.add_uav(vehicle, at(3, -2, rest_height(vehicle)));
    double fastest = 0.0, fastest_settled = 0.0;
    for (int i = 0; i < 10 * kTicksPerSecond; ++i) {
      world.tick();
      const double speed = world.state(UavIndex{0}).v_WB.norm();
      fastest = std::max(fastest, speed);
      ASSERT_EQ(world.contacts().size(), 1U);
      EXPECT_EQ(world.contacts()[0].other.kind, BodyId::Kind::ground);
      if (i > kTicksPerSecond) fastest_settled = std::max(fastest_settled, speed);
    }
    EXPECT_LT(fastest, 0.03);
    EXPECT_LT(fastest_settled, 1e-3);
    EXPECT_LT((world.state(UavIndex{0}).p_WB - Vector3d(3, -2, rest_height(vehicle))).norm(), 1e-3);
    EXPECT_LT(world.state(UavIndex{0}).q_WB.angularDistance(Quaterniond::Identity()), 1e-3);
  }
}

TEST(PhysicsWorld, ASleepingUavWakesWhenPushedOrHit) {
  const VehicleConfig vehicle;
  PhysicsWorld world({});
  world.add_uav(vehicle, at(0, 0, rest_height(vehicle)));
  world.add_uav(vehicle, at(5, 0, rest_height(vehicle)));
  for (int i = 0; i < 400; ++i) world.tick();
  const RigidBodyState asleep = world.state(UavIndex{0});
  for (int i = 0; i < 400; ++i) world.tick();
  EXPECT_EQ(world.state(UavIndex{0}).p_WB, asleep.p_WB);
  EXPECT_EQ(world.contacts().size(), 2U);
  for (int i = 0; i < 40; ++i) {
    world.apply_wrench(UavIndex{0}, {0, 0, 2.0 * vehicle.mass_kg * kWorldGravity}, Vector3d::Zero());
    world.tick();
  }
  EXPECT_NEAR(world.state(UavIndex{0}).v_WB.z(), 40 * kTickS * kWorldGravity, 1e-3);
  world.set_state(UavIndex{0}, {.p_WB = {5.2, 0, 1.5}, .v_WB = {0, 0, -4}});
  double fastest = 0.0;
  for (int i = 0; i < 400; ++i) {
    world.tick();
    fastest = std::max(fastest, world.state(UavIndex{1}).v_WB.norm());
  }
  EXPECT_GT(fastest, 0.1);
}

TEST(PhysicsWorld, AContactWithAWallIsReportedAtEverySpeedAndFromBothSides) {
  const TriangleMesh mesh = wall(5.0F);
  for (const double speed : {0.05, 0.5, 2.0, 8.0, 12.0}) {
    for (const double side : {-1.0, 1.0}) {
      PhysicsWorld world(mesh);
      world.add_uav({}, at(5.0 + side * 0.9, 0, 10));
      world.set_state(UavIndex{0}, {.p_WB = {5.0 + side * 0.9, 0, 10}, .v_WB = {-side * speed, 0, 0}});
      bool touched = false;
      for (int i = 0; i < 400 * 12 && !touched; ++i) {
        world.apply_wrench(UavIndex{0}, {0, 0, VehicleConfig{}.mass_kg * kWorldGravity}, Vector3d::Zero());
        world.tick();
        for (const Contact& contact : world.contacts()) {
          touched = true;
          EXPECT_EQ(contact.other.kind, BodyId::Kind::structure);
          EXPECT_NEAR(contact.p_W.x(), 5.0, 0.05);
        }
        ASSERT_GT(side * (world.state(UavIndex{0}).p_WB.x() - 5.0), 0.3) << "passed at " << speed;
      }
      EXPECT_TRUE(touched) << speed;
    }
  }
}

TEST(PhysicsWorld, TheWorldMissesNoTouchOnTheWay) {
  // The world searches for contacts only near the structure. Each triangle that a body overlaps at the beginning of a
  // tick must be a contact of that tick, also after tumbling through loose triangles, from far away, fast or slow.
  const TriangleMesh mesh = test::random_triangles(400, 11);
  const VehicleConfig vehicle = photographer();
  RandomStream random(4, "flights", 0);
  int touches = 0, flights_that_touch = 0;
  for (int flight = 0; flight < 30; ++flight) {
    PhysicsWorld world(mesh);
    const Vector3d start = test::random_in_box(random, {-40, -40, 5}, {40, 40, 40});
    world.add_uav(vehicle, at(start.x(), start.y(), start.z()));
    const double speed = flight % 2 == 0 ? 12.0 : 1.5;
    world.set_state(UavIndex{0}, {.p_WB = start,
                                  .v_WB = speed * (Vector3d(0, 0, 8) - start).normalized(),
                                  .w_WB_B = 3.0 * test::random_unit(random)});
    int here = 0;
    for (int i = 0; i < 1200 && here < 20; ++i) {
      const bool overlaps = world.touches_structure(vehicle, world.state(UavIndex{0}).X_WB());
      world.apply_wrench(UavIndex{0}, {0, 0, vehicle.mass_kg * kWorldGravity}, Vector3d::Zero());
      world.tick();
      if (!overlaps) continue;
      ++here;
      const auto is_structure = [](const Contact& c) { return c.other.kind == BodyId::Kind::structure; };
      ASSERT_TRUE(std::ranges::any_of(world.contacts(), is_structure)) << "flight " << flight << ", tick " << i;
    }
    touches += here;
    flights_that_touch += here > 0;
  }
  EXPECT_GT(touches, 60);
  EXPECT_GT(flights_that_touch, 8);
}

TEST(PhysicsWorld, AVehicleTouchesAWallOnlyWithinItsReach) {
  const VehicleConfig vehicle;
  const double reach = vehicle.arm_m * std::cos(M_PI / 6) + vehicle.rotor_radius_m;
  const TriangleMesh mesh = wall(5.0F);
  PhysicsWorld world(mesh);
  EXPECT_FALSE(world.touches_structure(vehicle, at(5.0 - reach - 0.01, 0, 10)));
  EXPECT_TRUE(world.touches_structure(vehicle, at(5.0 - reach + 0.01, 0, 10)));
  EXPECT_TRUE(world.touches_structure(vehicle, at(5.0, 0, 10)));
  EXPECT_TRUE(world.touches_structure(vehicle, at(5.0 + reach - 0.01, 0, 10)));
  EXPECT_FALSE(world.touches_structure(vehicle, at(5.0 + reach + 0.01, 0, 10)));
}

TEST(PhysicsWorld, ThinMembersDoNotPassThroughRotors) {
  // A 2 cm bar crosses the plane of the rotors, out of the box's way, at up to 8 m/s from above and below.
  const VehicleConfig vehicle;
  for (const double speed : {1.0, 4.0, 8.0}) {
    for (const double way : {-1.0, 1.0}) {
      for (int phase = 0; phase < 8; ++phase) {
        const TriangleMesh mesh = bar(0.45F, 10.0F, 0.02F);
        PhysicsWorld world(mesh);
        const Vector3d start(0, 0, 10.0 - vehicle.rotor_height_m - way * (0.3 + 0.0025 * phase));
        world.add_uav(vehicle, at(0, 0, start.z()));
        world.set_state(UavIndex{0}, {.p_WB = start, .v_WB = {0, 0, way * speed}});
        bool touched = false;
        for (int i = 0; i < 400 && !touched; ++i) {
          world.apply_wrench(UavIndex{0}, {0, 0, vehicle.mass_kg * kWorldGravity}, Vector3d::Zero());
          world.tick();
          touched = !world.contacts().empty();
        }
        EXPECT_TRUE(touched) << speed << " m/s, way " << way << ", phase " << phase;
      }
    }
  }
}

TEST(PhysicsWorld, AFloorSlabInTheGroundPlaneIsGround) {
  TriangleMesh mesh;
  mesh.vertices = {{-5, -5, 0}, {5, -5, 0.002F}, {0, 5, 0}};
  mesh.triangles = {{0, 1, 2}};
  const VehicleConfig vehicle;
  PhysicsWorld world(mesh);
  EXPECT_FALSE(world.touches_structure(vehicle, at(0, 0, rest_height(vehicle))));
  world.add_uav(vehicle, at(0, 0, rest_height(vehicle)));
  for (int i = 0; i < 40; ++i) world.tick();
  ASSERT_EQ(world.contacts().size(), 1U);
  EXPECT_EQ(world.contacts()[0].other.kind, BodyId::Kind::ground);
}

TEST(PhysicsWorld, TwoUavsThatMeetAreOneContact) {
  PhysicsWorld world({});
  world.add_uav({}, at(0, 0, 10));
  world.add_uav(photographer(), at(3, 0, 10));
  world.set_state(UavIndex{1}, {.p_WB = {3, 0, 10}, .v_WB = {-2, 0, 0}});
  for (int i = 0; i < 800 && world.contacts().empty(); ++i) world.tick();
  ASSERT_EQ(world.contacts().size(), 1U);
  EXPECT_EQ(world.contacts()[0].uav, 0U);
  EXPECT_EQ(world.contacts()[0].other, (BodyId{BodyId::Kind::uav, UavIndex{1}}));
  EXPECT_NEAR(world.contacts()[0].p_W.x(), 0.6, 0.15);
}

TEST(PhysicsWorld, AContactEndsWhenTheUavMovesAway) {
  const TriangleMesh mesh = wall(5.0F);
  PhysicsWorld world(mesh);
  world.add_uav({}, at(5, 0, 10));
  world.tick();
  EXPECT_FALSE(world.contacts().empty());
  world.set_state(UavIndex{0}, {.p_WB = {0, 0, 10}});
  world.tick();
  EXPECT_TRUE(world.contacts().empty());
}

/// The states of a tumbling, colliding fleet after 3 s.
std::vector<RigidBodyState> chaos(std::size_t fleet) {
  const TriangleMesh mesh = wall(2.0F);
  PhysicsWorld world(mesh);
  for (std::size_t i = 0; i < fleet; ++i) {
    const double x = 1.1 * static_cast<double>(i % 3);
    world.add_uav({}, at(x, 0.2 * static_cast<double>(i), 2.0 + 0.5 * static_cast<double>(i)));
    world.set_state(UavIndex(i), {.p_WB = {x, 0.2 * static_cast<double>(i), 2.0 + 0.5 * static_cast<double>(i)},
                                  .w_WB_B = {0.3, 0.1 * static_cast<double>(i), 0.2}});
  }
  for (int t = 0; t < 1200; ++t) world.tick();
  return world.states();
}

TEST(PhysicsWorld, ACollidingFleetRepeatsBitForBit) {
  const auto first = chaos(12);
  std::vector<std::unique_ptr<char[]>> noise;  // so that the second run allocates at other addresses
  for (std::size_t i = 1; i < 400; ++i) noise.push_back(std::make_unique<char[]>(37 * i % 5000 + 1));
  for (std::size_t i = 0; i < noise.size(); i += 3) noise[i].reset();
  const auto second = chaos(12);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].p_WB, second[i].p_WB);
    EXPECT_EQ(first[i].q_WB.coeffs(), second[i].q_WB.coeffs());
    EXPECT_EQ(first[i].v_WB, second[i].v_WB);
    EXPECT_EQ(first[i].w_WB_B, second[i].w_WB_B);
  }
}

/// One body has a state that the integration cannot handle; it must not affect another one beside it.
TEST(PhysicsWorld, ABodyThatLeavesTheWorldIsTakenOut) {
  for (const double speed : {1e5, 1e9, 1e150, 1e300}) {
    PhysicsWorld world({});
    world.keep_within(1000.0);
    world.add_uav({}, at(0, 0, 10));
    world.add_uav({}, at(5, 0, 10));
    world.set_state(UavIndex{0}, {.p_WB = {0, 0, 10}, .v_WB = {speed, 0, 0}, .w_WB_B = {0, speed, 0}});
    std::vector<std::size_t> strays;
    for (int t = 0; t < 100; ++t) {
      world.apply_wrench(UavIndex{0}, {speed, speed, 0}, {0, speed, 0});
      world.tick();
      strays.insert(strays.end(), world.strays().begin(), world.strays().end());
      for (const RigidBodyState& state : world.states()) {
        ASSERT_TRUE(state.p_WB.allFinite() && state.q_WB.coeffs().allFinite() && state.v_WB.allFinite());
        ASSERT_LE(state.p_WB.norm(), 1000.0) << speed;
      }
    }
    EXPECT_EQ(strays, std::vector<std::size_t>{0}) << speed;
    EXPECT_EQ(world.state(UavIndex{0}).v_WB, Vector3d(0, 0, 0));
    EXPECT_NEAR(world.state(UavIndex{1}).p_WB.z(), 10.0 - 0.5 * kWorldGravity * 0.25 * 0.25, 0.01)
        << "the other one falls on";
    EXPECT_NEAR(world.state(UavIndex{1}).p_WB.x(), 5.0, 1e-9);
  }
}

}  // namespace
}  // namespace skein::sim
