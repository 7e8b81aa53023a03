// Vehicles composed of links, whose centre of mass is not the origin of their frame, compared with equations of motion
// that are written down and integrated here, and with the quantities that every rigid body conserves.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/vehicle/airframe.hpp"
#include "sim_server/testing/test_flight.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

using test::Flight;
using test::hover_at;
using test::vehicle_named;

/// A rigid body by the Newton-Euler equations about its centre of mass, integrated with the Runge-Kutta method.
struct NewtonEuler {
  double mass = 0.0;
  Vector3d p_BBcm = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();  ///< about Bcm, axes of B

  // State: position and velocity of Bcm in W, attitude (w, x, y, z), body rates in B.
  Eigen::Matrix<double, 13, 1> x = Eigen::Matrix<double, 13, 1>::Zero();

  void add(double m, const Vector3d& own_inertia, const Vector3d& p_B) {
    parts.push_back({m, own_inertia, p_B});
    mass = 0.0;
    Vector3d moment = Vector3d::Zero();
    for (const Part& part : parts) {
      mass += part.mass;
      moment += part.mass * part.p_B;
    }
    p_BBcm = moment / mass;
    inertia.setZero();
    for (const Part& part : parts) {
      const Vector3d r = part.p_B - p_BBcm;
      inertia.diagonal() += part.inertia;
      inertia(0, 0) += part.mass * (r.y() * r.y() + r.z() * r.z());
      inertia(1, 1) += part.mass * (r.x() * r.x() + r.z() * r.z());
      inertia(2, 2) += part.mass * (r.x() * r.x() + r.y() * r.y());
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        inertia(i, j) -= part.mass * r[i] * r[j];
        inertia(j, i) = inertia(i, j);
      }
    }
  }
  void start(const RigidBodyState& state) {
    const Vector3d r_W = state.q_WB * p_BBcm;
    x << state.p_WB + r_W, state.v_WB + (state.q_WB * state.w_WB_B).cross(r_W), state.q_WB.w(), state.q_WB.vec(),
        state.w_WB_B;
  }
  static Quaterniond attitude(const Eigen::Matrix<double, 13, 1>& x) {
    return Quaterniond(x[6], x[7], x[8], x[9]).normalized();
  }
  /// The state of Bo, as in the odometry.
  RigidBodyState state() const {
    RigidBodyState state{.q_WB = attitude(x), .w_WB_B = x.tail<3>()};
    const Vector3d r_W = state.q_WB * p_BBcm;
    state.p_WB = x.head<3>() - r_W;
    state.v_WB = x.segment<3>(3) - (state.q_WB * state.w_WB_B).cross(r_W);
    return state;
  }
  /// @param wrench  of a state of Bo: the force in B, and the torque in B about Bcm.
  template <class WrenchOf>
  void step(double dt, const WrenchOf& wrench) {
    const auto slope = [&](const Eigen::Matrix<double, 13, 1>& at) {
      const NewtonEuler there{mass, p_BBcm, inertia, at, {}};
      const auto [force_B, torque_B] = wrench(there.state());
      const Vector3d w = at.tail<3>();
      const Quaterniond q = attitude(at), turn = q * Quaterniond(0.0, w.x(), w.y(), w.z());
      Eigen::Matrix<double, 13, 1> d;
      d << at.segment<3>(3), q * force_B / mass - Vector3d(0, 0, kWorldGravity), 0.5 * turn.w(), 0.5 * turn.vec(),
          inertia.inverse() * (torque_B - w.cross(inertia * w));
      return d;
    };
    const auto a = slope(x), b = slope(x + 0.5 * dt * a), c = slope(x + 0.5 * dt * b), d = slope(x + dt * c);
    x += dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }

  struct Part {
    double mass;
    Vector3d inertia, p_B;
  };
  std::vector<Part> parts;
};

std::pair<Vector3d, Vector3d> no_wrench(const RigidBodyState&) { return {Vector3d::Zero(), Vector3d::Zero()}; }

/// The benchmark's explorer in numbers: body, LiDAR with servo, six rotors.
NewtonEuler explorer_by_hand() {
  NewtonEuler body;
  body.add(2.5, {0.07648816666, 0.07648816666, 0.16283333333}, Vector3d::Zero());
  body.add(0.81, Vector3d::Zero(), {0, 0, 0.2});
  for (int i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi / 6.0 + i * std::numbers::pi / 3.0;
    body.add(0.0125, Vector3d::Zero(), {0.43 * std::cos(angle), 0.43 * std::sin(angle), 0.074});
  }
  return body;
}

/// Force and torque of six rotors at these speeds on the explorer, about its centre of mass.
std::pair<Vector3d, Vector3d> rotor_wrench(const NewtonEuler& body, const RotorSpeeds& speeds,
                                           const RigidBodyState& state) {
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  for (int i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi / 6.0 + i * std::numbers::pi / 3.0;
    const double speed = speeds[static_cast<std::size_t>(i)], thrust = 2.564574e-5 * speed * speed;
    const Vector3d hub(0.43 * std::cos(angle), 0.43 * std::sin(angle), 0.074);
    Vector3d across = state.q_WB.conjugate() * state.v_WB + state.w_WB_B.cross(hub);
    across.z() = 0.0;
    const Vector3d push = Vector3d(0, 0, thrust) - 8.06428e-5 * speed * across;
    force += push;
    torque += (hub - body.p_BBcm).cross(push) - 1e-6 * speed * across;
    torque.z() += (i % 2 == 0 ? -1.0 : 1.0) * 0.032 * thrust;
  }
  return {force, torque};
}

VehicleConfig lumped_explorer() {
  VehicleConfig lump = vehicle_named("explorer");
  lump.mass_kg = 3.385;
  lump.rotor_mass_kg = 0.0;
  lump.links.clear();
  return lump;
}

/// Greatest difference between the roll of a vehicle that is commanded to roll and the roll computed by hand [rad].
double worst_roll_gap(const VehicleConfig& config, double demanded_roll) {
  constexpr int kSteps = 8;  // of the physics per tick, so that the comparison is one of models
  constexpr double kStep = kTickS / kSteps;
  const ControlDemand demand{.roll = demanded_roll, .thrust_N = 3.385 * kWorldGravity};
  const RigidBodyState begin{.p_WB = {0, 0, 1000}, .v_WB = {3, -1, 0}};
  PhysicsWorld world({}, kStep);
  world.add_uav(config, begin.X_WB());
  world.set_state(UavIndex{0}, begin);
  NewtonEuler hand = explorer_by_hand();
  hand.start(begin);
  AttitudeController law(config), same_law(config);
  Rotors rotors(config, kStep), same_rotors(config, kStep);
  double worst = 0.0;
  for (Tick tick = 0; tick < ticks(1.5); ++tick) {
    const RotorSpeeds told = law.step(world.state(UavIndex{0}).q_WB, world.state(UavIndex{0}).w_WB_B, demand);
    const RotorSpeeds hand_told = same_law.step(hand.state().q_WB, hand.state().w_WB_B, demand);
    for (int i = 0; i < kSteps; ++i) {
      rotors.step(told);
      const RigidBodyState& state = world.state(UavIndex{0});
      const Wrench wrench = rotors.wrench(state);
      world.apply_wrench(UavIndex{0}, state.q_WB * wrench.force_B, state.q_WB * wrench.torque_B);
      world.tick();
      same_rotors.step(hand_told);
      hand.step(kStep, [&](const RigidBodyState& s) { return rotor_wrench(hand, same_rotors.speeds(), s); });
    }
    const auto roll = [](const RigidBodyState& s) { return roll_pitch_yaw(s.q_WB.toRotationMatrix()).roll; };
    worst = std::max(worst, std::abs(roll(world.state(UavIndex{0})) - roll(hand.state())));
  }
  return worst;
}

TEST(CompositeBody, TheExplorerRollsAsItsPartsTogetherDo) {
  for (const double roll : {0.3, -0.15}) {
    const double gap = worst_roll_gap(vehicle_named("explorer"), roll);
    const double lumped = worst_roll_gap(lumped_explorer(), roll);
    std::cout << "[ measured ] step of " << roll << " rad: within " << 1e3 * gap << " mrad; with the inertia of the "
              << "body alone " << 1e3 * lumped << " mrad\n";
    EXPECT_LT(gap, 0.003 * std::abs(roll));
    EXPECT_GT(lumped, 0.03 * std::abs(roll)) << "else the comparison could not tell the two models apart";
  }
}

TEST(CompositeBody, TheExplorerSpinsAndDropsAsItsPartsTogetherDo) {
  for (const Vector3d& w : {Vector3d(4, 0, 0), Vector3d(-1, 3, 5), Vector3d(0.2, 0.1, 8)}) {
    const RigidBodyState begin{.p_WB = {1, 2, 1000}, .v_WB = {2, -1, 3}, .w_WB_B = w};
    PhysicsWorld world({}, kTickS / 8);
    world.add_uav(vehicle_named("explorer"), begin.X_WB());
    world.set_state(UavIndex{0}, begin);
    NewtonEuler hand = explorer_by_hand();
    hand.start(begin);
    double farthest = 0.0;
    for (int i = 1; i <= 8 * ticks(2.0); ++i) {
      world.tick();
      hand.step(kTickS / 8, no_wrench);
      const RigidBodyState there = hand.state(), &here = world.state(UavIndex{0});
      // The world integrates a fall by a method of first order: the height is g t dt / 2 too low.
      const Vector3d low(0, 0, -0.5 * kWorldGravity * i * (kTickS / 8) * (kTickS / 8));
      ASSERT_LT((here.p_WB - there.p_WB - low).norm(), 1e-3) << i;
      ASSERT_LT((here.v_WB - there.v_WB).norm(), 2e-3) << i;
      ASSERT_LT(here.q_WB.angularDistance(there.q_WB), 2e-3) << i;
      const Vector3d parabola = begin.p_WB + begin.v_WB * (i * kTickS / 8);
      farthest = std::max(farthest, (here.p_WB - parabola).head<2>().norm());
    }
    EXPECT_GT(farthest, w.head<2>().norm() > 1.0 ? 0.05 : 0.0) << "Bo circles about the centre of mass";
  }
}

VehicleConfig drawn_vehicle(RandomStream& random) {
  VehicleConfig vehicle;
  vehicle.mass_kg = random.uniform(0.5, 4.0);
  const Vector3d spread = test::random_in_box(random, {0.02, 0.02, 0.02}, {0.1, 0.1, 0.1});
  vehicle.inertia = {spread.y() + spread.z(), spread.x() + spread.z(), spread.x() + spread.y()};
  vehicle.rotor_mass_kg = random.uniform(0.0, 0.05);
  for (int i = 0; i < 3; ++i) {
    vehicle.links.push_back({.name = "part",
                             .mass_kg = random.uniform(0.0, 0.8),
                             .inertia = Vector3d::Constant(random.uniform(0.0, 0.01)),
                             .p_BL = test::random_in_box(random, {-0.3, -0.3, -0.1}, {0.3, 0.3, 0.3}),
                             .box_m = {}});
  }
  return vehicle;
}

TEST(CompositeBody, AFreeBodyKeepsMomentumAndEnergyAboutItsCentreOfMass) {
  RandomStream random(3, "free_flights", 0);
  for (int flight = 0; flight < 20; ++flight) {
    const VehicleConfig vehicle = drawn_vehicle(random);
    const MassProperties whole = mass_properties(vehicle);
    ASSERT_GT(std::abs(whole.I_BBcm_B(0, 1)) + std::abs(whole.I_BBcm_B(1, 2)), 1e-4) << "it has products of inertia";
    RigidBodyState begin{.p_WB = {0, 0, 3000}, .v_WB = 5.0 * test::random_unit(random)};
    begin.q_WB = Quaterniond(test::rotation(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)));
    begin.w_WB_B = 4.0 * test::random_unit(random);
    PhysicsWorld world({});
    world.add_uav(vehicle, begin.X_WB());
    world.set_state(UavIndex{0}, begin);
    const auto arm_W = [&](const RigidBodyState& s) { return Vector3d(s.q_WB * whole.p_BBcm); };
    const auto centre_speed = [&](const RigidBodyState& s) {
      return Vector3d(s.v_WB + Vector3d(s.q_WB * s.w_WB_B).cross(arm_W(s)));
    };
    const auto spin = [&](const RigidBodyState& s) { return Vector3d(s.q_WB * (whole.I_BBcm_B * s.w_WB_B)); };
    const auto energy = [&](const RigidBodyState& s) { return 0.5 * s.w_WB_B.dot(whole.I_BBcm_B * s.w_WB_B); };
    const Vector3d p0 = begin.p_WB + arm_W(begin), v0 = centre_speed(begin), L0 = spin(begin);
    for (Tick tick = 1; tick <= ticks(3.0); ++tick) {
      world.tick();
      const RigidBodyState& state = world.state(UavIndex{0});
      const double t = seconds(tick);
      ASSERT_LT((centre_speed(state) - v0 + Vector3d(0, 0, kWorldGravity * t)).norm(), 1e-9);
      const Vector3d p = p0 + v0 * t - Vector3d(0, 0, 0.5 * kWorldGravity * t * (t + kTickS));
      ASSERT_LT((state.p_WB + arm_W(state) - p).norm(), 1e-8);
      ASSERT_LT((spin(state) - L0).norm(), 1e-6 * L0.norm());
      ASSERT_NEAR(energy(state), energy(begin), 0.01 * energy(begin));
    }
  }
}

TEST(CompositeBody, APushAtBoTurnsABodyWhoseCentreOfMassIsElsewhere) {
  // Force at Bo and torque: the work that they do is the energy gained, wherever the centre of mass is.
  RandomStream random(4, "pushes", 0);
  for (int flight = 0; flight < 20; ++flight) {
    const VehicleConfig vehicle = drawn_vehicle(random);
    const MassProperties whole = mass_properties(vehicle);
    const Vector3d force_B = 8.0 * test::random_unit(random), torque_B = 0.2 * test::random_unit(random);
    PhysicsWorld world({}, kTickS / 16);
    world.add_uav(vehicle, Isometry3d(Eigen::Translation3d(0, 0, 1000)));
    const auto energy = [&](const RigidBodyState& s) {
      const Vector3d arm_W = s.q_WB * whole.p_BBcm, w_W = s.q_WB * s.w_WB_B;
      return whole.mass_kg * (0.5 * (s.v_WB + w_W.cross(arm_W)).squaredNorm() + kWorldGravity * (s.p_WB + arm_W).z()) +
             0.5 * s.w_WB_B.dot(whole.I_BBcm_B * s.w_WB_B);
    };
    const double begin = energy(world.state(UavIndex{0}));
    double work = 0.0, effort = 0.0;
    for (Tick i = 0; i < 16 * ticks(0.5); ++i) {
      const RigidBodyState a = world.state(UavIndex{0});
      world.apply_wrench(UavIndex{0}, a.q_WB * force_B, a.q_WB * torque_B);
      world.tick();
      const RigidBodyState& b = world.state(UavIndex{0});
      const double done = force_B.dot(0.5 * (a.q_WB.conjugate() * a.v_WB + b.q_WB.conjugate() * b.v_WB)) +
                          torque_B.dot(0.5 * (a.w_WB_B + b.w_WB_B));
      work += done * kTickS / 16;
      effort += std::abs(done) * kTickS / 16;
    }
    // The integration of the fall is of first order, which loses exactly g^2 t dt / 2 per mass.
    const double lost = 0.5 * whole.mass_kg * kWorldGravity * kWorldGravity * 0.5 * kTickS / 16;
    EXPECT_NEAR(energy(world.state(UavIndex{0})) - begin, work - lost, 0.002 * effort) << flight;
  }
}

TEST(CompositeBody, AVehicleRestsOnItsLowestBoxAndHoversWithoutDrift) {
  RandomStream random(5, "landings", 0);
  for (int i = 0; i < 10; ++i) {
    VehicleConfig vehicle = vehicle_named("explorer");
    VehicleLink& lidar = vehicle.links[0];
    lidar.p_BL = {random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), random.uniform(-0.15, 0.2)};
    PhysicsWorld world({});
    world.add_uav(vehicle, Isometry3d(Eigen::Translation3d(0, 0, rest_height(vehicle))));
    for (int tick = 0; tick < 3 * kTicksPerSecond; ++tick) world.tick();
    EXPECT_NEAR(world.state(UavIndex{0}).p_WB.z(), rest_height(vehicle), 1e-3) << lidar.p_BL.transpose();
    EXPECT_LT(world.state(UavIndex{0}).q_WB.angularDistance(Quaterniond::Identity()), 2e-3);

    Flight flight(vehicle);
    flight.fly(30.0, hover_at({1, 2, 50.5}));
    double fastest = 0.0;
    flight.fly(5.0, hover_at({1, 2, 50.5}), [&] { fastest = std::max(fastest, flight.state().v_WB.norm()); });
    EXPECT_LT(fastest, 0.01) << lidar.p_BL.transpose();
    EXPECT_LT((flight.state().p_WB - Vector3d(1, 2, 50.5)).norm(), 0.05) << lidar.p_BL.transpose();
  }
}

TEST(PlausibleVehicles, AVehicleThatTheReaderAcceptsStaysInTheWorld) {
  // Random numbers over decades: the reader refuses a vehicle, or its speeds stay finite, however badly it flies.
  RandomStream random(6, "oddities", 0);
  const auto decades = [&](double middle, double lowest, double highest) {
    return middle * std::pow(10.0, random.uniform(lowest, highest));
  };
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "skein_odd_vehicle.yaml";
  int accepted = 0, refused = 0;
  for (int i = 0; i < 600; ++i) {
    std::ofstream(file) << "name: odd\nrole: photographer\nmass_kg: " << std::max(0.01, decades(3.0, -2.0, 1.0))
                        << "\ninertia_kg_m2: [" << decades(0.08, -1.6, 1) << ", " << decades(0.08, -1.6, 1) << ", "
                        << decades(0.16, -1.6, 1) << "]\nrotor_drag: " << std::min(1.0, decades(8e-5, -1, 3.5))
                        << "\nrolling_moment: " << decades(1e-6, -1, 4) << "\n";
    VehicleConfig vehicle;
    try {
      vehicle = load_vehicle(file.string(), {});
      ++accepted;
    } catch (const InputError&) {
      ++refused;
      continue;
    }
    Flight flight(vehicle, 5000.0, test::no_limits());
    flight.fly(4.0, hover_at({20, 5, 5000}), [&] {
      ASSERT_LT(flight.state().v_WB.norm(), 1e4) << to_yaml(vehicle);
      ASSERT_LT(flight.state().w_WB_B.norm(), 1e4) << to_yaml(vehicle);
    });
  }
  std::filesystem::remove(file);
  EXPECT_GT(accepted, 60);
  EXPECT_GT(refused, 80);
}

TEST(CompositeBody, TheLidarCollidesUpToItsTop) {
  TriangleMesh ceiling;
  ceiling.vertices = {{-2, -2, 10}, {2, -2, 10}, {2, 2, 10}, {-2, 2, 10}};
  ceiling.triangles = {{0, 1, 2}, {0, 2, 3}};
  const VehicleConfig explorer = vehicle_named("explorer");
  PhysicsWorld world(ceiling);
  const auto below = [](double z) { return Isometry3d(Eigen::Translation3d(0, 0, 10.0 - z)); };
  EXPECT_TRUE(world.touches_structure(explorer, below(0.235)));
  EXPECT_FALSE(world.touches_structure(explorer, below(0.245)));
  EXPECT_FALSE(world.touches_structure(lumped_explorer(), below(0.235)));
  world.add_uav(explorer, below(0.4));
  world.set_state(UavIndex{0}, {.p_WB = {0, 0, 9.6}, .v_WB = {0, 0, 1}});
  double highest = 0.0;
  while (world.contacts().empty() && highest < 10.0) {
    world.apply_wrench(UavIndex{0}, {0, 0, 3.385 * kWorldGravity}, Vector3d::Zero());
    world.tick();
    highest = world.state(UavIndex{0}).p_WB.z();
  }
  EXPECT_NEAR(highest, 10.0 - 0.24, 0.005);
}

}  // namespace
}  // namespace skein::sim
