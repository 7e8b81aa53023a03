// Compares the rigid body with mechanics: momentum, energy, work, gyroscopes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/vehicle/airframe.hpp"
#include "sim_server/testing/test_flight.hpp"

namespace skein::sim {
namespace {

using test::Flight;
using test::vehicle_named;

/// A body without rotors, far above the ground.
class SpinningBody {
 public:
  SpinningBody(const VehicleConfig& config, const Vector3d& w_WB_B, const Vector3d& v_WB = Vector3d::Zero(),
               int steps = 1)
      : whole_(mass_properties(config)), steps_(steps), world_({}, kTickS / steps) {
    world_.add_uav(config, Isometry3d(Eigen::Translation3d(0, 0, kHeight)));
    world_.set_state(UavIndex{0}, {.p_WB = {0, 0, kHeight}, .v_WB = v_WB, .w_WB_B = w_WB_B});
  }
  /// @param torque_B  acts all the time.
  void move(double duration_s, const Vector3d& torque_B = Vector3d::Zero()) {
    for (Tick i = 0; i < steps_ * ticks(duration_s); ++i) {
      world_.apply_wrench(UavIndex{0}, Vector3d::Zero(), state().q_WB * torque_B);
      world_.tick();
    }
  }
  const RigidBodyState& state() const { return world_.state(UavIndex{0}); }
  Vector3d angular_momentum_W() const { return state().q_WB * (whole_.I_BBcm_B * state().w_WB_B); }
  double spin_energy() const { return 0.5 * state().w_WB_B.dot(whole_.I_BBcm_B * state().w_WB_B); }
  double total_energy() const {
    return spin_energy() + whole_.mass_kg * (0.5 * v_WBcm().squaredNorm() + kWorldGravity * p_WBcm().z());
  }
  Vector3d p_WBcm() const { return state().p_WB + state().q_WB * whole_.p_BBcm; }
  Vector3d v_WBcm() const { return state().v_WB + state().q_WB * state().w_WB_B.cross(whole_.p_BBcm); }

 private:
  static constexpr double kHeight = 5000.0;
  MassProperties whole_;
  int steps_;
  PhysicsWorld world_;
};

TEST(RigidBody, TumblingKeepsAngularMomentumAndSpinEnergy) {
  for (const char* name : {"explorer", "photographer"}) {
    for (const Vector3d& w : {Vector3d(3, 2, -4), Vector3d(0.5, 6, 0.5), Vector3d(-1, 0.2, 9)}) {
      SpinningBody body(vehicle_named(name), w);
      const Vector3d L = body.angular_momentum_W();
      const double E = body.spin_energy();
      for (int i = 0; i < 10; ++i) {
        body.move(1.0);
        EXPECT_LT((body.angular_momentum_W() - L).norm(), 1e-6 * L.norm());
        EXPECT_NEAR(body.spin_energy(), E, 0.005 * E);
      }
      EXPECT_NEAR(body.state().q_WB.norm(), 1.0, 1e-12);
    }
  }
}

TEST(RigidBody, FreeFallTradesHeightForSpeed) {
  // Each step integrates the height with the speed at its end, so exactly g^2 t dt / 2 per mass is lost.
  for (const int steps : {1, 2, 8}) {
    const VehicleConfig config = vehicle_named("photographer");
    SpinningBody body(config, {2, -1, 3}, {4, -3, 10}, steps);
    const double E = body.total_energy(), spin = body.spin_energy();
    const Vector3d v_WBcm = body.v_WBcm();
    body.move(4.0);
    const double lost = 0.5 * mass_properties(config).mass_kg * kWorldGravity * kWorldGravity * 4.0 * kTickS / steps;
    EXPECT_NEAR(body.total_energy() - E, -lost, 1e-6 * E + 0.01 * spin) << steps;
    EXPECT_NEAR(body.v_WBcm().x(), v_WBcm.x(), 1e-9) << "nothing pulls sideways";
    EXPECT_NEAR(body.v_WBcm().z(), v_WBcm.z() - 4.0 * kWorldGravity, 1e-6);
  }
}

TEST(RigidBody, TorqueChangesAngularMomentumByItsImpulse) {
  SpinningBody body(vehicle_named("photographer"), {1, 2, 3});
  const Vector3d L = body.angular_momentum_W();
  Vector3d push = Vector3d::Zero();
  for (int i = 0; i < 200; ++i) {
    const Vector3d torque(0.02, -0.01, 0.03);
    push += body.state().q_WB * torque * kTickS;
    body.move(kTickS, torque);
  }
  EXPECT_LT((body.angular_momentum_W() - L - push).norm(), 1e-6 * push.norm());
}

TEST(RigidBody, ASymmetricTopPrecesses) {
  // Its axis circles the angular momentum; seen from the body, the rates turn at (Iz - Ix) / Ix times the spin.
  const VehicleConfig explorer = vehicle_named("explorer");  // Ix = Iy
  const double spin = 4.0, cross = 0.6;
  SpinningBody body(explorer, {cross, 0, spin});
  const Matrix3d inertia = mass_properties(explorer).I_BBcm_B;
  const double rate = (inertia(2, 2) / inertia(0, 0) - 1.0) * spin;
  for (int i = 1; i <= 20; ++i) {
    body.move(0.1);
    const Vector3d& w = body.state().w_WB_B;
    EXPECT_NEAR(w.z(), spin, 1e-3);
    EXPECT_NEAR(w.x(), cross * std::cos(rate * 0.1 * i), 0.02) << i;
    EXPECT_NEAR(w.y(), cross * std::sin(rate * 0.1 * i), 0.02) << i;
  }
}

TEST(RigidBody, AGyroscopeTurnsAcrossTheTorque) {
  // A fast top that is pushed about x turns about y: its axis moves at torque by angular momentum.
  const VehicleConfig explorer = vehicle_named("explorer");
  const double spin = 60.0, torque = 0.05, duration = 1.0;
  PhysicsWorld world({});
  world.add_uav(explorer, Isometry3d(Eigen::Translation3d(0, 0, 1000)));
  world.set_state(UavIndex{0}, {.p_WB = {0, 0, 1000}, .w_WB_B = {0, 0, spin}});
  for (Tick i = 0; i < ticks(duration); ++i) {
    world.apply_wrench(UavIndex{0}, Vector3d::Zero(), {torque, 0, 0});
    world.tick();
  }
  const Vector3d axis_W = world.state(UavIndex{0}).q_WB * Vector3d::UnitZ();
  EXPECT_NEAR(axis_W.x(), torque * duration / (mass_properties(explorer).I_BBcm_B(2, 2) * spin), 5e-4);
  EXPECT_NEAR(axis_W.y(), 0.0, 5e-4);
}

TEST(RigidBody, ABodySpinsSteadilyAboutTheAxesOfGreatestAndLeastInertiaOnly) {
  const VehicleConfig photographer = vehicle_named("photographer");  // Ix < Iy < Iz
  const auto axis_wanders = [&](const Vector3d& axis_B) {
    SpinningBody body(photographer, 8.0 * axis_B + Vector3d(0.01, 0.01, 0.01));
    double least = 1.0;
    for (int i = 0; i < 150; ++i) {
      body.move(0.1);
      least = std::min(least, body.state().w_WB_B.normalized().dot(axis_B));
    }
    return least;
  };
  EXPECT_GT(axis_wanders(Vector3d::UnitX()), 0.99);
  EXPECT_GT(axis_wanders(Vector3d::UnitZ()), 0.99);
  EXPECT_LT(axis_wanders(Vector3d::UnitY()), -0.9) << "about the middle axis it flips, as a thrown racket does";
}

TEST(RigidBody, WorkOfTheRotorsIsTheEnergyGained) {
  // Sums force times distance plus torque times angle over the steps of a flight with climbs, turns and stops.
  for (const char* name : {"explorer", "photographer"}) {
    const VehicleConfig config = vehicle_named(name);
    Flight flight(config, 50.0);
    const MassProperties whole = mass_properties(config);
    const auto energy = [&](const RigidBodyState& state) {
      const Vector3d v_WBcm = state.v_WB + state.q_WB * state.w_WB_B.cross(whole.p_BBcm);
      const double height = (state.p_WB + state.q_WB * whole.p_BBcm).z();
      return whole.mass_kg * (0.5 * v_WBcm.squaredNorm() + kWorldGravity * height) +
             0.5 * state.w_WB_B.dot(whole.I_BBcm_B * state.w_WB_B);
    };
    flight.fly(5.0, test::hover_at({0.5, 0, 50}));
    const double begin = energy(flight.state());
    double work = 0.0, worst = 0.0, most = 0.0;
    const auto pilot = [](double t) -> std::optional<TrajectoryCommand> {
      if (t < 15.0) return TrajectoryCommand{.p_WB = {20, 10, 80}, .yaw = 2.0};
      if (t < 25.0) return TrajectoryCommand{.v_WB = {-3, 2, -1.5}};
      return TrajectoryCommand{.p_WB = {0, 0, 55}, .yaw = -1.0};
    };
    flight.fly(40.0, pilot, [&] {
      const RigidBodyState &a = flight.before(), &b = flight.state();
      work += flight.step_s() * (flight.wrench().force_B.dot(a.q_WB.conjugate() * (0.5 * (a.v_WB + b.v_WB))) +
                                 flight.wrench().torque_B.dot(0.5 * (a.w_WB_B + b.w_WB_B)));
      const double gained = energy(b) - begin;
      worst = std::max(worst, std::abs(gained - work));
      most = std::max(most, std::abs(gained));
    });
    EXPECT_GT(most, 0.8 * whole.mass_kg * kWorldGravity * 30.0);
    EXPECT_LT(worst, 0.002 * most) << name;
  }
}

}  // namespace
}  // namespace skein::sim
