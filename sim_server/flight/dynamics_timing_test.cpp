// The ticks at which controllers, camera, LiDAR and the mission's clock act, in a simulation read after every tick.
#include <gtest/gtest.h>

#include <memory>

#include "core/scenario/scenario_reader.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/testing/test_flight.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// An explorer before a wall with interest points; every exchange is one tick.
class Timing : public testing::Test {
 protected:
  Timing() {
    scenario_.file = "timing.yaml";
    scenario_.exchange_period_s = kTickS;
    scenario_.duration_s = 8.0;
    scenario_.fleet.push_back({.name = "uav", .vehicle = test::vehicle_named("explorer")});
    Scene scene;
    test::add_box(scene.mesh, {8.5, 0, 10}, {1, 20, 20});
    for (int y = -8; y <= 8; ++y) {
      for (int z = 1; z <= 18; ++z) {
        scene.points.push_back({{8.0F, static_cast<float>(y), static_cast<float>(z)}, {-1, 0, 0}});
      }
    }
    simulation_ = std::make_unique<Simulation>(scenario_, std::move(scene), 0);
  }
  Simulation& sim() { return *simulation_; }
  void advance() {
    sim().command_trajectory(UavIndex{0}, {.p_WB = {0.5, 0, 4}});
    sim().advance();
  }

  Scenario scenario_;
  std::unique_ptr<Simulation> simulation_;
};

TEST_F(Timing, ControllersRunAt20Hz) {
  // The gimbal moves at its control steps only, once every 20 ticks, at the rate that it reports.
  GimbalState last = sim().uav(UavIndex{0}).gimbal;
  int moves = 0;
  for (int i = 0; i < 800; ++i) {
    sim().command_gimbal(UavIndex{0}, {GimbalMode::rate, 0.01, -0.02});
    advance();
    const GimbalState& now = sim().uav(UavIndex{0}).gimbal;
    const bool moved = now.yaw != last.yaw;
    EXPECT_EQ(moved, (sim().tick() - 1) % 20 == 0) << sim().tick();
    if (moved) {
      EXPECT_NEAR(now.yaw - last.yaw, -0.02 * 0.05, 1e-12);
    }
    moves += moved;
    last = now;
  }
  EXPECT_EQ(moves, 40);
}

TEST_F(Timing, TheAttitudeLoopRunsAt400Hz) {
  // When the body tilts between two steps of the 20 Hz law, the rotors respond within the tick.
  const VehicleConfig config = test::vehicle_named("explorer");
  Vehicle vehicle(config, {});
  RigidBodyState state{.p_WB = {0, 0, 10}};
  vehicle.control(0, state, TrajectoryCommand{.p_WB = {0, 0, 10}}, std::nullopt);
  for (int i = 0; i < 400; ++i) vehicle.step(state);
  const RotorSpeeds level = vehicle.rotor_speeds();
  vehicle.step(state);
  EXPECT_NEAR(vehicle.rotor_speeds()[1], level[1], 1e-6);
  state.q_WB = Quaterniond(Eigen::AngleAxisd(0.1, Vector3d::UnitX()));
  vehicle.step(state);
  EXPECT_LT(vehicle.rotor_speeds()[1], level[1] - 3.0) << "the left rotor gives way";
  EXPECT_GT(vehicle.rotor_speeds()[4], level[4] + 3.0) << "the right one pushes";
}

TEST_F(Timing, PicturesAreExactly41TicksApartAndScans40) {
  std::vector<Tick> pictures, scans;
  for (int i = 0; i < 2800; ++i) {
    advance();
    for (const CaptureEvent& event : sim().events().captures) pictures.push_back(event.capture.tick);
    for (const LidarEvent& event : sim().events().scans) scans.push_back(event.scan.tick);
  }
  ASSERT_GT(pictures.size(), 50U);
  for (std::size_t i = 1; i < pictures.size(); ++i) EXPECT_EQ(pictures[i] - pictures[i - 1], 41);
  EXPECT_GE(pictures[0], *sim().mission().start_tick());
  ASSERT_EQ(scans.size(), 70U);
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(scans[i], static_cast<Tick>(40 * (i + 1)));
}

TEST_F(Timing, TheClockCountsTicksFromTakeOffToEnd) {
  EXPECT_EQ(sim().mission().remaining_s(sim().tick()), 8.0) << "computing before the take-off is free";
  for (int i = 0; i < 400; ++i) sim().advance();
  EXPECT_EQ(sim().mission().remaining_s(sim().tick()), 8.0);
  const double ground = sim().uav(UavIndex{0}).state.p_WB.z();
  while (sim().mission().phase() == Phase::waiting && sim().tick() < 4000) {
    const RigidBodyState& state = sim().uav(UavIndex{0}).state;
    EXPECT_FALSE(state.p_WB.z() > ground + 0.1 && state.v_WB.norm() > 0.1) << "should have started";
    advance();
  }
  const Tick start = *sim().mission().start_tick();
  EXPECT_EQ(start, sim().tick());
  EXPECT_NEAR(sim().uav(UavIndex{0}).state.p_WB.z(), ground + 0.1, 0.01);
  while (sim().mission().phase() == Phase::flying && sim().tick() < 10000) {
    EXPECT_NEAR(sim().mission().remaining_s(sim().tick()), 8.0 - seconds(sim().tick() - start), 1e-9);
    advance();
  }
  EXPECT_EQ(sim().mission().end(), MissionEnd::duration);
  EXPECT_EQ(*sim().mission().end_tick() - start, 3200);
}

TEST_F(Timing, ARunThatNeverFliesEndsAtTheTimeout) {
  // Commands arrive, but none makes the UAV take off.
  scenario_.takeoff_timeout_s = 1.5;
  scenario_.exchange_period_s = 0.05;
  Simulation waiting(scenario_, sim().scene(), 0);
  while (waiting.mission().phase() == Phase::waiting && waiting.tick() < 4000) {
    waiting.command_gimbal(UavIndex{0}, {GimbalMode::angle, 0.1, 0.1});
    waiting.advance();
  }
  EXPECT_EQ(waiting.mission().end(), MissionEnd::takeoff_timeout);
  EXPECT_EQ(waiting.mission().end_tick(), 600);
  EXPECT_FALSE(waiting.mission().start_tick());
  EXPECT_TRUE(waiting.referee().ledger().empty()) << "no picture before a take-off";
}

TEST_F(Timing, TheEndCutsAllControl) {
  while (sim().mission().phase() != Phase::ended) advance();
  const std::uint64_t captures = sim().uav(UavIndex{0}).captures;
  const GimbalState gimbal = sim().uav(UavIndex{0}).gimbal;
  const double height = sim().uav(UavIndex{0}).state.p_WB.z();
  for (int i = 0; i < 320; ++i) {
    EXPECT_TRUE(sim().command_trajectory(UavIndex{0}, {.p_WB = {0.5, 0, 4}}));
    sim().command_gimbal(UavIndex{0}, {GimbalMode::angle, 0.5, 0.5});
    sim().trigger_camera(UavIndex{0});
    sim().advance();
    EXPECT_TRUE(sim().events().scans.empty());
    EXPECT_TRUE(sim().events().captures.empty());
  }
  EXPECT_LT(sim().uav(UavIndex{0}).state.p_WB.z(), height - 0.4 * kWorldGravity * 0.8 * 0.8) << "it falls";
  EXPECT_EQ(sim().uav(UavIndex{0}).gimbal.yaw, gimbal.yaw);
  EXPECT_EQ(sim().uav(UavIndex{0}).captures, captures);
}

}  // namespace
}  // namespace skein::sim
