// Sensors, rotors and commands that fail: first the single functions, then whole simulations with such faults.
#include "sim_server/flight/vehicle_faults.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "core/math/random_stream.hpp"
#include "sim_server/flight/command_link.hpp"
#include "sim_server/record/fault_timeline.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/testing/test_flight.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

Fault fault(double at_s, std::optional<double> until_s, FaultAction action) {
  return {.at_s = at_s, .until_s = until_s, .action = std::move(action)};
}

FaultPlan plan(std::vector<Fault> faults) { return {"test.yaml", "", "", std::move(faults)}; }

TEST(VehicleConditions, ConditionsLastAsLongAsTheirFaultAndAffectOnlyItsUav) {
  const FaultPlan faults = plan({fault(1.0, 2.0, LidarFailure{"a"}), fault(1.5, std::nullopt, CameraFailure{"b"}),
                                 fault(1.0, 2.0, MotorFailure{"b", 4, 0.25}), fault(1.0, 2.0, CommandDelay{"a", 3}),
                                 fault(0.0, std::nullopt, Blackout{"a"}), fault(0.0, std::nullopt, Kill{"b"})});
  const auto at = [&](double t) { return vehicle_conditions(faults, {"a", "b"}, ticks(t)); };
  for (const double t : {0.0, 0.95, 2.0, 3.0}) {
    EXPECT_TRUE(at(t)[0].lidar_works) << t;
    EXPECT_EQ(at(t)[0].command_delay, 0) << t;
    EXPECT_EQ(at(t)[1].rotor_shares, VehicleCondition().rotor_shares) << t;
  }
  for (const double t : {1.0, 1.5, 1.95}) {
    EXPECT_FALSE(at(t)[0].lidar_works) << t;
    EXPECT_TRUE(at(t)[1].lidar_works) << t;
    EXPECT_EQ(at(t)[0].command_delay, 3) << t;
    EXPECT_EQ(at(t)[1].command_delay, 0) << t;
    EXPECT_EQ(at(t)[1].rotor_shares[4], 0.25) << t;
    EXPECT_EQ(at(t)[1].rotor_shares[3], 1.0) << t;
    EXPECT_EQ(at(t)[0].rotor_shares, VehicleCondition().rotor_shares) << t;
  }
  EXPECT_TRUE(at(1.45)[1].camera_works);
  EXPECT_FALSE(at(100.0)[1].camera_works);
  EXPECT_TRUE(at(100.0)[0].camera_works);
}

TEST(VehicleConditions, ConditionsDistinguishTwoEqualBatteryLossesWithoutAGap) {
  const FaultPlan faults = plan({fault(1.0, 2.0, BatteryLoss{"a", 0.3}), fault(2.0, 3.0, BatteryLoss{"a", 0.3})});
  const auto at = [&](double t) { return vehicle_conditions(faults, {"a", "b"}, ticks(t))[0]; };
  EXPECT_EQ(at(0.95).most_charge, 1.0);
  for (const double t : {1.0, 1.95, 2.0, 2.95}) {
    EXPECT_EQ(at(t).most_charge, 0.3);
    EXPECT_EQ(at(t).charge_lost, ticks(t < 2.0 ? 1.0 : 2.0)) << t;
  }
  EXPECT_EQ(at(3.0).charge_lost, 0);
}

TEST(FaultTimeline, TheTimelineTellsEachBeginningAndEndOnce) {
  const FaultPlan faults = plan({fault(0.1, 0.2, LidarFailure{"a"}), fault(0.2, std::nullopt, CameraFailure{"b"}),
                                 fault(9.0, std::nullopt, Blackout{"a"})});
  FaultTimeline timeline(faults);
  std::vector<std::string> lines;
  for (std::uint64_t k = 0; k < 10; ++k) {
    for (std::string& line : timeline.enter_step(k, static_cast<Tick>(20 * k))) lines.push_back(std::move(line));
  }
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_NE(lines[0].find("lidar_failure of a"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("end of fault"), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find("camera_failure of b"), std::string::npos) << lines[2];
  const nlohmann::json json = json_of(timeline.report());
  ASSERT_EQ(json.size(), 3U);
  EXPECT_EQ(json[0]["began_step"], 2);
  EXPECT_EQ(json[0]["ended_step"], 4);
  EXPECT_EQ(json[1]["began_step"], 4);
  EXPECT_TRUE(json[1]["ended_step"].is_null());
  EXPECT_TRUE(json[1]["until_s"].is_null());
  EXPECT_TRUE(json[2]["began_step"].is_null()) << "the run ended before";
}

// Commands arrive in the order in which they were sent. None is lost, and none arrives before its delay is over.
TEST(CommandLink, NoCommandOvertakesAnotherHoweverDelaysChange) {
  RandomStream random(1, "delays", 0);
  for (const bool late : {false, true}) {
    CommandLink link({.X_WB = Isometry3d::Identity(), .late_commands = late});
    int last = -1, triggers = 0, sent = 0, delay = 0;
    for (int k = 0; k < 2000; ++k) {
      if (random.uniform(0.0, 1.0) < 0.1) delay = static_cast<int>(random.uniform(0.0, 6.0));
      if (k >= 1900) delay = 0;
      link.outbox().gimbal = GimbalCommand{.yaw = static_cast<double>(k)};
      link.outbox().trigger = k % 50 == 0;
      sent += k % 50 == 0;
      const Commands arrived = link.exchange(20 * k, delay);
      triggers += arrived.trigger;
      if (!arrived.gimbal) continue;
      const int newest = static_cast<int>(arrived.gimbal->yaw);
      EXPECT_GT(newest, last);
      EXPECT_EQ(newest, k - delay - (late ? 1 : 0)) << "the newest command whose delay is over";
      last = newest;
    }
    EXPECT_EQ(triggers, sent);
  }
}

/// A field with a wall at x = 12 and points on its near side; "lead" is an explorer, "other" a photographer beside it.
class Faulty : public testing::Test {
 protected:
  Faulty() {
    scenario_.file = "field.yaml";
    scenario_.station_position = {-5, 0, 0.3};
    test::add_box(scene_.mesh, {12.5, 0, 10}, {1, 20, 20});
    for (int y = -8; y <= 8; ++y) {
      for (int z = 2; z <= 18; ++z) {
        scene_.points.push_back({{12.0F, static_cast<float>(y), static_cast<float>(z)}, {-1, 0, 0}});
      }
    }
    scenario_.fleet.push_back({.name = "lead", .vehicle = test::vehicle_named("explorer"), .start = {0, 0}});
    scenario_.fleet.push_back({.name = "other", .vehicle = test::vehicle_named("photographer"), .start = {0, 6}});
  }

  /// Flies both to 4 m in front of the wall, sweeping sideways and up so that key frames and captures never end.
  void fly(const FaultPlan& faults, double duration_s, const std::function<void(double t)>& watch) {
    simulation_ = std::make_unique<Simulation>(scenario_, scene_, 0, faults);
    for (int k = 0; seconds(20 * k) < duration_s; ++k) {
      const double t = seconds(20 * k), y = 3.0 * std::sin(0.5 * t);
      simulation_->command_trajectory(UavIndex{0}, {.p_WB = {6, y, 5 + 0.3 * t}});
      simulation_->command_trajectory(UavIndex{1}, {.p_WB = {6, y + 6, 5 + 0.3 * t}});
      simulation_->advance();
      watch(t);
    }
  }
  void gimbals_to(double yaw) {
    for (const UavIndex i : FirstUavs(2)) simulation_->command_gimbal(i, {GimbalMode::angle, 0.0, yaw});
  }
  const UavView& lead() const { return simulation_->uav(UavIndex{0}); }

  Scenario scenario_;
  Scene scene_;
  std::unique_ptr<Simulation> simulation_;
};

TEST_F(Faulty, AUavWhoseLidarFailsMakesNoScansAndNoKeyFrames) {
  int before = 0, within = 0, after = 0;
  fly(plan({fault(10.0, 15.0, LidarFailure{"lead"})}), 25.0, [&](double t) {
    const StepEvents& events = simulation_->events();
    const int seen = static_cast<int>(events.scans.size() + events.key_frames.size());
    (t < 10.0 ? before : t < 15.0 ? within : after) += seen;
  });
  EXPECT_GT(before, 90);
  EXPECT_EQ(within, 0);
  EXPECT_GT(after, 90);
}

TEST_F(Faulty, AUavWhoseCameraFailsMakesNoCaptures) {
  std::array<std::array<int, 3>, 2> captures{};
  fly(plan({fault(10.0, 15.0, CameraFailure{"other"})}), 25.0, [&](double t) {
    for (const CaptureEvent& event : simulation_->events().captures) {
      ++captures[event.uav][t < 10.0 ? 0 : t < 15.0 ? 1 : 2];
    }
  });
  for (const int count : captures[0]) EXPECT_GT(count, 20) << "the other camera works on";
  EXPECT_GT(captures[1][0], 20);
  EXPECT_EQ(captures[1][1], 0);
  EXPECT_GT(captures[1][2], 20);
}

TEST_F(Faulty, ATriggerDuringTheFailureIsLost) {
  int captures = 0;
  fly(plan({fault(10.0, 15.0, CameraFailure{"other"})}), 20.0, [&](double t) {
    for (const CaptureEvent& event : simulation_->events().captures) captures += event.uav == 1 && t >= 10.0;
    if (t >= 9.9 && t < 14.5) simulation_->trigger_camera(UavIndex{1});
  });
  EXPECT_EQ(captures, 0) << "triggered by hand from 9.9 s on, and never while it worked again";
}

TEST_F(Faulty, ADeadRotorBringsTheUavDownAndOnlyThisOne) {
  fly(plan({fault(10.0, std::nullopt, MotorFailure{"lead", 2, 0.0})}), 20.0, [](double) {});
  EXPECT_LT(lead().state.p_WB.z(), 1.0) << "six rotors in a ring do not bear the loss of one";
  EXPECT_TRUE(simulation_->uav(UavIndex{1}).airborne);
  EXPECT_GT(simulation_->uav(UavIndex{1}).state.p_WB.z(), 9.0);
}

TEST_F(Faulty, AUavFliesOnWithAWeakRotor) {
  fly(plan({fault(10.0, std::nullopt, MotorFailure{"lead", 2, 0.9})}), 20.0, [](double) {});
  EXPECT_TRUE(lead().alive);
  EXPECT_GT(lead().state.p_WB.z(), 9.0);
}

TEST_F(Faulty, DelayedCommandsActLaterByTheirDelay) {
  std::vector<Vector3d> prompt, delayed;
  fly({}, 12.0, [&](double) { prompt.push_back(lead().state.p_WB); });
  constexpr int kDelay = 8;
  fly(plan({fault(0.0, std::nullopt, CommandDelay{"lead", kDelay})}), 12.0,
      [&](double) { delayed.push_back(lead().state.p_WB); });
  for (std::size_t k = kDelay + 1; k < prompt.size(); ++k) {
    // Not to the last bit: meanwhile the body has settled on the ground by some hundredths of a millimetre. One step
    // more or less would be 0.1 m.
    EXPECT_LT((delayed[k] - prompt[k - kDelay]).norm(), 3e-3) << "the same flight, later; step " << k;
  }
}

TEST_F(Faulty, AFaultShortensTheRangeOfALinkInOneDirectionAndForItsTimeOnly) {
  LinkEffect short_one;
  short_one.from = {"lead"};
  short_one.to = {"other"};
  short_one.range_m = 3.0;  // they are 6 m apart
  bool as_told = true;
  fly(plan({fault(4.0, 6.0, short_one)}), 8.0, [&](double) {
    const double t = seconds(simulation_->tick());
    const bool there = simulation_->links().at(Node{1}, Node{2}) != 0,
               back = simulation_->links().at(Node{2}, Node{1}) != 0;
    as_told &= back && there == (t < 4.0 || t >= 6.0);
  });
  EXPECT_TRUE(as_told);
}

TEST_F(Faulty, ABlackoutSilencesBothWaysButNotTheLineOfSight) {
  bool cut_all_through = true, seen_before = false, key_frames_out = false;
  fly(plan({fault(10.0, 15.0, Blackout{"lead"})}), 12.0, [&](double t) {
    const Node lead{1}, other{2};
    const auto linked = [&](Node from, Node to) { return simulation_->open_links().at(from, to) != 0; };
    ASSERT_NE(simulation_->links().at(Node{1}, Node{2}), 0) << "they see each other all the time";
    const bool open =
        linked(lead, other) || linked(other, lead) || linked(kStationNode, lead) || linked(lead, kStationNode);
    if (t < 9.0) seen_before |= linked(lead, other) && linked(other, lead);
    if (t >= 10.0)
      cut_all_through &= !open && linked(kStationNode, other) == (simulation_->links().at(kStationNode, other) != 0);
    for (const KeyFrameEvent& event : simulation_->events().key_frames) {
      key_frames_out |= t >= 10.0 && !event.neighbours.empty();
    }
  });
  EXPECT_TRUE(seen_before);
  EXPECT_TRUE(cut_all_through);
  EXPECT_FALSE(key_frames_out);
}

TEST_F(Faulty, AFrozenOdometryReportsAnOldPoseAndAJumpingOneAWrongPose) {
  const Vector3d offset(2, -1, 0.5);
  const FaultPlan faults =
      plan({fault(10.0, 15.0, OdometryFreeze{"lead"}), fault(6.0, 8.0, OdometryJump{"other", offset})});
  RigidBodyState frozen;
  double moved = 0.0;
  fly(faults, 20.0, [&](double) {
    const double t = seconds(simulation_->tick());
    const UavView &a = lead(), &b = simulation_->uav(UavIndex{1});
    if (t < 10.0) frozen = a.state;
    const bool is_frozen = t >= 10.0 && t < 15.0;
    if (is_frozen) moved = std::max(moved, (a.state.p_WB - a.told.p_WB).norm());
    const RigidBodyState& expected = is_frozen ? a.told : a.state;
    EXPECT_EQ(a.told.p_WB, expected.p_WB) << t;
    EXPECT_EQ(a.told.v_WB, expected.v_WB) << t;
    if (is_frozen) {
      EXPECT_LT((a.told.p_WB - frozen.p_WB).norm(), 0.2) << "the pose at the step in which the fault began";
    }
    const Vector3d jump = t >= 6.0 && t < 8.0 ? offset : Vector3d::Zero();
    EXPECT_LT((b.told.p_WB - b.state.p_WB - jump).norm(), 1e-12) << t;
  });
  EXPECT_GT(moved, 2.0) << "it flew on meanwhile";
}

TEST_F(Faulty, AFalseOdometryDoesNotChangeTheFlightOfGivenCommands) {
  std::vector<Vector3d> with, without;
  fly(plan({fault(5.0, std::nullopt, OdometryJump{"lead", {5, 5, 5}})}), 10.0,
      [&](double) { with.push_back(lead().state.p_WB); });
  fly({}, 10.0, [&](double) { without.push_back(lead().state.p_WB); });
  EXPECT_EQ(with, without) << "commands are the same, and the flight controller uses the true state";
}

TEST_F(Faulty, AStuckGimbalStaysAndThenObeysTheLastCommand) {
  double stuck_at = 0.0;
  bool still = true, other_moves = false;
  fly(plan({fault(10.0, 15.0, StuckGimbal{"lead"})}), 20.0, [&](double t) {
    gimbals_to(t < 11.0 ? 0.3 : -0.3);
    const double yaw = lead().gimbal.yaw;
    if (t < 10.0) stuck_at = yaw;
    if (t >= 10.0 && t < 15.0) still &= yaw == stuck_at && lead().gimbal.yaw_rate == 0.0;
    other_moves |= t > 10.0 && t < 15.0 && simulation_->uav(UavIndex{1}).gimbal.yaw_rate != 0.0;
  });
  EXPECT_TRUE(still);
  EXPECT_TRUE(other_moves) << "the gimbal of the other UAV works on";
  EXPECT_NEAR(lead().gimbal.yaw, -0.3, 1e-3);
}

TEST_F(Faulty, AWaitingFaultActsFromTheExchangeAtWhichItIsSetOff) {
  FaultPlan faults = plan({fault(0.0, std::nullopt, LidarFailure{"lead"}), fault(0.0, std::nullopt, Blackout{"lead"})});
  for (Fault& one : faults.faults) {
    one.when = FaultCondition{"whatever"};
    one.waits = true;
    one.for_s = 2.0;
  }
  std::size_t scans_before = 0, scans_within = 0, scans_after = 0;
  const Node lead_node{1}, other_node{2};
  fly(faults, 15.0, [&](double) {
    const double t = seconds(simulation_->tick());
    const bool open = simulation_->open_links().at(lead_node, other_node) != 0;
    EXPECT_EQ(open, (t < 10.0 || t >= 12.0) && simulation_->links().at(lead_node, other_node) != 0) << t;
    (t <= 10.0 ? scans_before : t <= 12.0 ? scans_within : scans_after) += simulation_->events().scans.size();
    const Tick next = simulation_->tick() + 20;
    for (std::size_t i = 0; i < 2 && next == ticks(10.0); ++i) simulation_->set_off(i, next);
  });
  EXPECT_GT(scans_before, 50U);
  EXPECT_EQ(scans_within, 0U);
  EXPECT_GT(scans_after, 20U);
}

}  // namespace
}  // namespace skein::sim
