#include "sim_server/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// A few UAVs on a field; a wall from y = -10 to 10 at x = 12, 20 m high, with interest points on its near side.
class Field : public testing::Test {
 protected:
  Field() {
    scenario_.file = "field.yaml";
    scenario_.station_position = {-5, 0, 0.3};
    scene_.mesh = {};
    test::add_box(scene_.mesh, {12.5, 0, 10}, {1, 20, 20});
    for (int y = -8; y <= 8; ++y) {
      for (int z = 2; z <= 18; ++z) {
        scene_.points.push_back({{12.0F, static_cast<float>(y), static_cast<float>(z)}, {-1, 0, 0}});
      }
    }
  }
  void add(const std::string& type, double x, double y) {
    scenario_.fleet.push_back({.name = "uav" + std::to_string(scenario_.fleet.size()),
                               .vehicle = load_vehicle(type, source_path("config")),
                               .start = {x, y}});
  }
  Simulation& start(std::uint64_t seed = 0) {
    simulation_ = std::make_unique<Simulation>(scenario_, scene_, seed);
    return *simulation_;
  }
  /// All UAVs fly to their targets for this time; `watch` gets the events of each exchange.
  void fly(
      double duration_s, const std::vector<TrajectoryCommand>& commands,
      const std::function<void(const StepEvents&)>& watch = [](const StepEvents&) {}) {
    for (double t = 0.0; t < duration_s - 1e-9; t += scenario_.exchange_period_s) {
      for (std::size_t i = 0; i < commands.size(); ++i) simulation_->command_trajectory(UavIndex(i), commands[i]);
      simulation_->advance();
      watch(simulation_->events());
    }
  }

  Scenario scenario_;
  Scene scene_;
  std::unique_ptr<Simulation> simulation_;
};

TrajectoryCommand to(double x, double y, double z) { return {.p_WB = {x, y, z}}; }

TEST_F(Field, TheMissionWaitsForTheTakeoffAndThenRunsTheClock) {
  add("photographer", 0, 0);
  Simulation& sim = start();
  EXPECT_EQ(sim.step(), 0U);
  for (int i = 0; i < 40; ++i) sim.advance();
  EXPECT_EQ(sim.step(), 40U);
  EXPECT_EQ(sim.tick(), 800);
  EXPECT_EQ(sim.mission().phase(), Phase::waiting);
  EXPECT_EQ(sim.uav(UavIndex{0}).distance_m, 0.0);
  fly(3.0, {to(0.5, 0, 5)});
  ASSERT_EQ(sim.mission().phase(), Phase::flying);
  EXPECT_TRUE(sim.uav(UavIndex{0}).airborne);
  const Tick begun = *sim.mission().start_tick();
  EXPECT_GT(begun, 800);
  EXPECT_LT(begun, 800 + kTicksPerSecond);
  EXPECT_DOUBLE_EQ(sim.mission().remaining_s(sim.tick()), scenario_.duration_s - seconds(sim.tick() - begun));
}

TEST_F(Field, FlyingIntoTheWallKillsAndIsLogged) {
  add("explorer", 0, 0);
  Simulation& sim = start();
  fly(4.0, {to(1, 3, 6)});
  std::vector<Collision> collisions;
  Tick seen_at = 0;
  fly(6.0, {TrajectoryCommand{.v_WB = {3, 0, 0}}}, [&](const StepEvents& events) {
    if (events.collisions.empty()) return;
    EXPECT_TRUE(collisions.empty());
    collisions = events.collisions;
    seen_at = sim.tick();
    EXPECT_FALSE(sim.uav(UavIndex{0}).alive);
  });
  ASSERT_EQ(collisions.size(), 1U);
  EXPECT_EQ(collisions[0].with.kind, BodyId::Kind::structure);
  EXPECT_NEAR(collisions[0].p_W.x(), 12.0, 0.1);
  EXPECT_NEAR(collisions[0].p_W.y(), 3.0, 0.8);
  EXPECT_GT(collisions[0].tick, seen_at - 20);
  EXPECT_LE(collisions[0].tick, seen_at);
  ASSERT_FALSE(sim.referee().ledger().empty());
  EXPECT_TRUE(sim.referee().ledger().back().collision);
  EXPECT_EQ(sim.referee().ledger().back().tick, collisions[0].tick);
  EXPECT_GT(sim.uav(UavIndex{0}).captures, 10U);
  EXPECT_EQ(sim.referee().earned().score(), 0.0) << "only UAVs without a collision count";
  EXPECT_EQ(sim.mission().end(), MissionEnd::no_uav_flies);
  EXPECT_LT(sim.uav(UavIndex{0}).state.p_WB.z(), 1.5) << "the wreck falls";
}

TEST_F(Field, UavsThatMeetBothDieAndTheThirdFliesOn) {
  add("explorer", 0, 0);
  add("photographer", 6, 0);
  add("photographer", 0, 8);
  Simulation& sim = start();
  fly(4.0, {to(0.5, 0, 6), to(6, 0, 6), to(0.5, 8, 6)});
  std::vector<Collision> collisions;
  fly(4.0, {to(6, 0, 6), to(6, 0, 6), to(0.5, 8, 6)}, [&](const StepEvents& events) {
    collisions.insert(collisions.end(), events.collisions.begin(), events.collisions.end());
  });
  ASSERT_EQ(collisions.size(), 2U);
  EXPECT_EQ(collisions[0].uav, 0U);
  EXPECT_EQ(collisions[0].with, (BodyId{BodyId::Kind::uav, UavIndex{1}}));
  EXPECT_EQ(collisions[1].uav, 1U);
  EXPECT_EQ(collisions[0].p_W, collisions[1].p_W);
  EXPECT_TRUE(sim.uav(UavIndex{2}).alive);
  EXPECT_EQ(sim.mission().phase(), Phase::flying);
  for (const Node node : FirstNodes(4)) EXPECT_EQ(sim.links().at(Node{1}, node), 0) << "the dead have no links";
}

TEST_F(Field, LandingOnTheGroundIsNoCollision) {
  add("photographer", 0, 0);
  Simulation& sim = start();
  fly(3.0, {to(0.5, 0, 2)});
  fly(8.0, {TrajectoryCommand{.v_WB = {0, 0, -0.4}}});
  EXPECT_TRUE(sim.uav(UavIndex{0}).alive);
  EXPECT_EQ(sim.mission().end(), MissionEnd::no_uav_flies);
}

TEST_F(Field, RefusedCommandsAreReportedAndCounted) {
  add("photographer", 0, 0);
  Simulation& sim = start();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(sim.command_trajectory(UavIndex{0}, {.v_WB = {20, 0, 0}}));
  EXPECT_FALSE(sim.command_gimbal(UavIndex{0}, {GimbalMode::angle, nan, 0}));
  EXPECT_TRUE(sim.command_trajectory(UavIndex{0}, to(100, 0, 5)));
  EXPECT_TRUE(sim.events().rejections.empty());
  sim.advance();
  ASSERT_EQ(sim.events().rejections.size(), 2U);
  EXPECT_EQ(sim.events().rejections[0].command, RejectionEvent::Command::trajectory);
  EXPECT_NE(sim.events().rejections[0].reason.find("20 m/s"), std::string::npos);
  EXPECT_EQ(sim.events().rejections[1].command, RejectionEvent::Command::gimbal);
  EXPECT_EQ(sim.events().rejections[1].total, 2U);
  EXPECT_EQ(sim.uav(UavIndex{0}).commands_rejected, 2U);
  EXPECT_EQ(sim.uav(UavIndex{0}).first_rejected, Tick{0});
  sim.advance();
  EXPECT_TRUE(sim.events().rejections.empty());
}

TEST_F(Field, PicturesAreTakenEvery41TicksAndEnterTheLedger) {
  add("photographer", 0, 0);
  Simulation& sim = start();
  std::vector<Tick> pictures;
  std::uint64_t entries = 0;
  fly(12.0, {to(6, 0, 6)}, [&](const StepEvents& events) {
    for (const CaptureEvent& event : events.captures) {
      pictures.push_back(event.capture.tick);
      EXPECT_FALSE(event.capture.detections.empty());
      EXPECT_EQ(event.report.has_value(), event.capture.improved());
    }
    EXPECT_EQ(events.ledger_begin, entries);
    entries = events.ledger_end;
    EXPECT_EQ(entries, sim.referee().ledger().size());
  });
  ASSERT_GT(pictures.size(), 50U);
  for (std::size_t i = 1; i < pictures.size(); ++i) EXPECT_EQ((pictures[i] - pictures[i - 1]) % 41, 0);
  EXPECT_EQ(sim.uav(UavIndex{0}).captures, pictures.size());
  EXPECT_GT(sim.referee().earned().points_detected(), 20U);
}

TEST_F(Field, HandTriggeredCamerasWaitForTheTrigger) {
  add("photographer", 0, 0);
  Simulation& sim = start();
  fly(6.0, {to(6, 0, 6)});
  const std::uint64_t automatic = sim.uav(UavIndex{0}).captures;
  EXPECT_GT(automatic, 0U);
  sim.trigger_camera(UavIndex{0});
  fly(2.0, {to(6, 0, 6)});
  EXPECT_EQ(sim.uav(UavIndex{0}).captures, automatic + 1);
  std::vector<Tick> pictures;
  for (int i = 0; i < 20; ++i) {
    sim.trigger_camera(UavIndex{0});
    fly(0.05, {to(6, 0, 6)}, [&](const StepEvents& events) {
      for (const CaptureEvent& event : events.captures) pictures.push_back(event.capture.tick);
    });
  }
  ASSERT_GT(pictures.size(), 5U);
  for (std::size_t i = 1; i < pictures.size(); ++i) EXPECT_GE(pictures[i] - pictures[i - 1], 41);
}

/// The data that a UAV receives about its pictures follow from its own pictures alone. So it learns neither the fleet's
/// score nor which points others have photographed.
TEST_F(Field, AUavLearnsNothingOfThePicturesOfOthers) {
  add("explorer", 0, -3);
  add("photographer", 0, 3);
  struct Seen {
    std::vector<CaptureReport> reports;  ///< of the first UAV
    std::vector<float> best;             ///< of all its detections
    std::vector<Vector3d> places_W;      ///< of both UAVs
    double score = 0.0;                  ///< of the fleet
  };
  const auto flown = [&](bool other_photographs) {
    Simulation& sim = start(3);
    if (!other_photographs) sim.trigger_camera(UavIndex{1});  // from now on, its camera waits for triggers
    Seen seen;
    fly(12.0, {to(6, -2, 6), to(6, 2, 6)}, [&](const StepEvents& events) {
      for (const CaptureEvent& event : events.captures) {
        if (event.uav != UavIndex{0}) continue;
        if (event.report) seen.reports.push_back(*event.report);
        for (const Detection& detection : event.capture.detections) seen.best.push_back(detection.best);
      }
      for (const UavIndex uav : FirstUavs(2)) seen.places_W.push_back(sim.uav(uav).told.p_WB);
    });
    seen.score = sim.referee().earned().score();
    return seen;
  };
  const Seen alone = flown(false), both = flown(true);
  EXPECT_GT(both.score, alone.score) << "the other UAV photographs points, too";
  EXPECT_EQ(both.places_W, alone.places_W) << "both UAVs fly as before";
  ASSERT_FALSE(alone.reports.empty());
  EXPECT_EQ(both.reports, alone.reports);
  EXPECT_EQ(both.best, alone.best);
}

TEST_F(Field, GimbalTurnsTheCameraAndItsRateIsReported) {
  add("photographer", 0, 0);
  Simulation& sim = start();
  sim.command_gimbal(UavIndex{0}, {GimbalMode::angle, 0.3, -0.5});
  sim.advance();
  EXPECT_LT(sim.uav(UavIndex{0}).gimbal.yaw_rate, -1.0);
  for (int i = 0; i < 20; ++i) sim.advance();
  EXPECT_NEAR(sim.uav(UavIndex{0}).gimbal.pitch, 0.3, 1e-6);
  EXPECT_NEAR(sim.uav(UavIndex{0}).gimbal.yaw, -0.5, 1e-6);
}

TEST_F(Field, OnlyExplorersScanAndNeighboursInSightGetTheKeyFrame) {
  add("explorer", 0, 0);
  add("photographer", 3, 0);
  add("photographer", 20, 0);  // behind the wall
  Simulation& sim = start();
  ASSERT_EQ(sim.events().scans.size(), 1U) << "the first scan is taken before anything moves";
  ASSERT_EQ(sim.events().key_frames.size(), 1U);
  EXPECT_EQ(sim.events().key_frames[0].neighbours, std::vector{UavIndex{1}});
  std::vector<Tick> scans;
  for (int i = 0; i < 8; ++i) {
    sim.advance();
    for (const LidarEvent& event : sim.events().scans) {
      EXPECT_EQ(event.uav, 0U);
      EXPECT_FALSE(event.scan.points_W.empty());
      scans.push_back(event.scan.tick);
    }
  }
  EXPECT_EQ(scans, (std::vector<Tick>{40, 80, 120, 160}));
}

TEST_F(Field, LinksAreSymmetricAndTheWallBlocksThem) {
  add("explorer", 0, 0);
  add("photographer", 20, 0);
  const Simulation& sim = start();
  const std::vector<std::uint8_t> wanted = {0, 1, 0,  //
                                            1, 0, 0,  //
                                            0, 0, 0};
  EXPECT_EQ(sim.links().row_major(), wanted);
}

TEST_F(Field, LinksEndAtTheirRange) {
  add("explorer", 0, 0);
  add("photographer", 8, 0);
  LinkEffect short_way_back;
  short_way_back.from = {scenario_.fleet[1].name};
  short_way_back.range_m = 7.0;
  scenario_.links = {short_way_back};
  const Simulation& sim = start();
  EXPECT_EQ(sim.links().at(Node{1}, Node{2}), 1);
  EXPECT_EQ(sim.links().at(Node{2}, Node{1}), 0) << "they are 8 m apart";
}

TEST_F(Field, StoppedUavFallsAndIsNotDead) {
  add("photographer", 0, 0);
  Simulation& sim = start();
  fly(4.0, {to(0.5, 0, 6)});
  sim.stop(UavIndex{0});
  fly(4.0, {to(0.5, 0, 6)});
  EXPECT_LT(sim.uav(UavIndex{0}).state.p_WB.z(), 0.5);
  EXPECT_TRUE(sim.uav(UavIndex{0}).alive);
  EXPECT_EQ(sim.mission().phase(), Phase::ended);
}

TEST_F(Field, TheSimulationCountsDistanceSpeedAndIdleness) {
  add("photographer", 0, -30);  // nothing to see there
  Simulation& sim = start();
  fly(4.0, {to(0.5, -30, 5)});
  const UavView before = sim.uav(UavIndex{0});
  fly(8.0, {to(0.5, -10, 5)});
  EXPECT_NEAR(sim.uav(UavIndex{0}).distance_m - before.distance_m, 20.0, 0.5);
  EXPECT_GT(sim.uav(UavIndex{0}).max_speed_mps, 3.0);
  EXPECT_EQ(sim.uav(UavIndex{0}).idle_s, before.idle_s);
  fly(20.0, {to(0.5, -10, 5)});
  EXPECT_GT(sim.uav(UavIndex{0}).idle_s, 12.0);
}

TEST_F(Field, DelayedMotorsStartWithTheNewestCommand) {
  add("photographer", 0, 0);
  add("photographer", 0, 5);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Simulation& sim = start(seed);
    fly(0.05, {to(0.5, 0, 40), to(0.5, 5, 40)});  // only one exchange has these commands
    fly(8.0, {to(0.5, 0, 5), to(0.5, 5, 5)});
    EXPECT_NEAR(sim.uav(UavIndex{0}).state.p_WB.z(), 5.0, 0.3);
    EXPECT_NEAR(sim.uav(UavIndex{1}).state.p_WB.z(), 5.0, 0.3);
  }
}

// The reader refuses such a vehicle. Any other state that becomes infinite must end in the same way.
TEST_F(Field, AUavWhoseStateBecomesInfiniteIsOutAndTheOthersFlyOn) {
  add("photographer", 0, 0);
  add("photographer", 0, 4);
  VehicleConfig& bad = scenario_.fleet[0].vehicle;
  bad.rotor_drag = 1.0;
  bad.mass_kg = 0.01;
  bad.rotor_mass_kg = 1e-4;
  std::vector<std::string> digests;
  for (int run = 0; run < 2; ++run) {
    Simulation& sim = start();
    RunDigest digest(scenario_.uav_names());
    std::vector<Stray> strays;
    fly(6.0, {to(8, 0, 5), to(0, 4, 5)}, [&](const StepEvents& events) {
      strays.insert(strays.end(), events.strays.begin(), events.strays.end());
      EXPECT_TRUE(events.collisions.empty());
      digest.add(sim.digest_input());
      for (const UavView& uav : sim.uavs()) {
        ASSERT_TRUE(uav.state.p_WB.allFinite() && uav.state.v_WB.allFinite() && uav.state.q_WB.coeffs().allFinite());
        ASSERT_TRUE(std::isfinite(uav.distance_m) && std::isfinite(uav.max_speed_mps));
      }
    });
    ASSERT_EQ(strays.size(), 1U);
    EXPECT_EQ(strays[0].uav, 0U);
    EXPECT_EQ(strays[0].p_W, sim.uav(UavIndex{0}).state.p_WB);
    EXPECT_FALSE(sim.uav(UavIndex{0}).alive);
    EXPECT_EQ(sim.links().at(kStationNode, Node{1}), 0) << "the UAV that is out has no link to the station";
    EXPECT_TRUE(sim.uav(UavIndex{1}).alive && sim.uav(UavIndex{1}).airborne);
    EXPECT_NEAR((sim.uav(UavIndex{1}).state.p_WB - Vector3d(0, 4, 5)).norm(), 0.0, 0.3);
    digests.push_back(digest.hex());
  }
  EXPECT_EQ(digests[0], digests[1]);
}

}  // namespace
}  // namespace skein::sim
