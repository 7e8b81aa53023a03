// The on-board software as a whole, with a planner that only records its input.
#include "uav_agent/onboard/agent.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {
namespace {

/// The planner's input in the last exchange, and the output that it is to give.
struct Tape {
  std::size_t boxes = 0, undelivered = 0, cells = 0;
  bool station_linked = false, near_is_free = false;
  TrackingState tracking = {};
  std::vector<KeyFrame> key_frames = {};
  std::vector<Scan> scans = {};
  PlannerOutput answer = {};
};

class TapePlanner final : public Planner {
 public:
  explicit TapePlanner(Tape& tape) : tape_(tape) {}
  PlannerOutput plan(const PlannerInput& in) override {
    tape_.boxes = in.boxes.size();
    tape_.undelivered = in.undelivered_captures;
    tape_.cells = in.map.occupied_cells();
    tape_.station_linked = in.station_linked;
    tape_.tracking = in.tracking;
    tape_.key_frames.assign(in.key_frames.begin(), in.key_frames.end());
    tape_.scans.assign(in.scans.begin(), in.scans.end());
    tape_.near_is_free = in.map.known_free({3.0, 0.0, 10.0});
    return tape_.answer;
  }

 private:
  Tape& tape_;
};

/// UAV 0 of two explorers and a photographer.
AgentConfig fleet_of_three() {
  AgentConfig config;
  config.fleet.resize(3);
  config.fleet[1].p_WB_start = {20.0, 0.0, 0.0};
  config.fleet[2].p_WB_start = {40.0, 0.0, 0.0};
  config.fleet[2].role = Role::photographer;
  return config;
}

class AgentTest : public testing::Test {
 protected:
  AgentTest() : agent_(fleet_of_three(), std::make_unique<TapePlanner>(tape_)) { input_.state.p_WB = {0.0, 0.0, 10.0}; }

  AgentOutput step() {
    const AgentOutput output = agent_.step(input_);
    ++input_.k;
    input_.tick += 20;
    input_.key_frames.clear();
    input_.capture_reports.clear();
    input_.capture_acks.clear();
    input_.boxes.clear();
    input_.scans.clear();
    return output;
  }
  static std::vector<Eigen::Vector3f> wall() {
    std::vector<Eigen::Vector3f> points;
    for (float y = -6.0F; y <= 6.0F; y += 0.3F) {
      for (float z = 4.0F; z <= 16.0F; z += 0.3F) points.emplace_back(12.0F, y, z);
    }
    return points;
  }

  Tape tape_;
  Agent agent_;
  AgentInput input_;
};

TEST_F(AgentTest, CommandsNothingUntilItsPlannerDoes) {
  const AgentOutput output = step();
  EXPECT_FALSE(output.trajectory);
  EXPECT_FALSE(output.gimbal);
  EXPECT_TRUE(output.captures.empty());
}

TEST_F(AgentTest, RemembersBoxesAndRepeatsCommands) {
  input_.boxes.resize(3);
  tape_.answer.motion = Path{{{{0.0, 0.0, 20.0}, 2.0}}};
  tape_.answer.gimbal = GimbalCommand{GimbalMode::angle, 0.3, 0.1};
  step();
  tape_.answer = {};
  for (int i = 0; i < 200; ++i) {
    const AgentOutput output = step();
    ASSERT_TRUE(output.trajectory) << "the controller holds after 0.1 s without commands";
    ASSERT_TRUE(output.gimbal);
    EXPECT_EQ(output.gimbal->pitch, 0.3);
    input_.state.p_WB = output.trajectory->p_WB;
  }
  EXPECT_EQ(tape_.boxes, 3U);
  EXPECT_NEAR(input_.state.p_WB.z(), 20.0, 1e-6);
}

TEST_F(AgentTest, RecordsForWhichUavItsPlannerWaitedAndWhen) {
  const auto wait = [&](std::optional<std::size_t> mate, int exchanges) {
    tape_.answer.waits_for = mate;
    for (int i = 0; i < exchanges; ++i) step();
  };
  wait(1, 20);
  wait({}, 10);
  wait(1, 10);  // a break of half a second does not count
  wait(2, 20);
  wait({}, 40);
  wait(2, 20);
  EXPECT_NEAR(agent_.waited_s(), 3.5, 1e-9);
  ASSERT_EQ(agent_.waits().size(), 3U);
  const std::vector<WaitSpan> expected = {{0.0, 2.0, 1}, {2.0, 3.0, 2}, {5.0, 6.0, 2}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(agent_.waits()[i].from_s, expected[i].from_s, 1e-9);
    EXPECT_NEAR(agent_.waits()[i].until_s, expected[i].until_s, 1e-9);
    EXPECT_EQ(agent_.waits()[i].mate, expected[i].mate);
  }
}

TEST_F(AgentTest, KeepsThePointOfAimInTheImage) {
  tape_.answer.gimbal = Vector3d(10.0, 10.0, 0.0);
  input_.state.q_WB = Eigen::AngleAxisd(0.5, Vector3d::UnitZ());
  const auto gimbal = *step().gimbal;
  EXPECT_NEAR(gimbal.yaw, std::atan2(1.0, 1.0) - 0.5, 0.03);
  EXPECT_NEAR(gimbal.pitch, std::atan2(10.0, std::hypot(10.0, 10.0)), 0.03) << "positive looks down";
  tape_.answer.gimbal = Vector3d(-10.0, 0.0, 10.0);
  EXPECT_LE(std::abs(step().gimbal->yaw), M_PI / 2.0 + 1e-9) << "behind: as far as the gimbal goes";
}

TEST_F(AgentTest, APeerThatWasNeverSeenIsAssumedToBeAtItsStart) {
  auto points = wall();
  for (float a = 0.0F; a < 6.0F; a += 0.4F) points.emplace_back(20.0F + 0.5F * std::cos(a), 0.5F * std::sin(a), 0.6F);
  input_.key_frames = {{.points_W = points}};
  step();
  const std::size_t with_body = tape_.cells;
  Tape other;
  Agent fresh(fleet_of_three(), std::make_unique<TapePlanner>(other));
  AgentInput bare;
  bare.state = input_.state;
  bare.key_frames = {{.points_W = wall()}};
  fresh.step(bare);
  EXPECT_EQ(with_body, other.cells) << "the other UAV is not on the map";
}

TEST_F(AgentTest, MarksFreeSpaceOnlyIfItKnowsWhereTheSensorStood) {
  const Neighbour first{node_of_uav(UavIndex{1}), {0.0, 0.0, 10.0}}, second{node_of_uav(UavIndex{2}), {0.0, 5.0, 10.0}};
  input_.state.p_WB = {0.0, -30.0, 10.0};
  input_.key_frames = {{.points_W = wall()}};
  step();
  EXPECT_FALSE(tape_.near_is_free) << "no UAV with a LiDAR is linked";
  input_.neighbours = {first, second};
  input_.key_frames = {{.points_W = wall()}};
  step();
  EXPECT_TRUE(tape_.near_is_free) << "only one of the linked UAVs has a LiDAR";
}

TEST_F(AgentTest, MarksFreeSpaceFromTheSourceOfAKeyFrame) {
  input_.neighbours = {{node_of_uav(UavIndex{1}), {0.0, 0.0, 30.0}}};
  input_.key_frames = {{.points_W = wall(), .source = node_of_uav(UavIndex{0})}};
  step();
  EXPECT_TRUE(tape_.near_is_free) << "the key frame is its own, seen from its position";
}

TEST_F(AgentTest, DeliversThroughTheDirectLinkOnly) {
  input_.capture_reports = {{.capture = 0, .bytes = 3}, {.capture = 1, .bytes = 1}};
  EXPECT_TRUE(step().captures.empty());
  EXPECT_EQ(tape_.undelivered, 2U);
  input_.neighbours = {{kStationNode, {0.0, 0.0, 0.3}}};
  const auto sent = step().captures;
  EXPECT_TRUE(tape_.station_linked);
  EXPECT_EQ(sent, (std::vector<std::uint64_t>{0, 1}));
  input_.capture_acks = {0, 1};
  step();
  EXPECT_EQ(tape_.undelivered, 0U);
}

TEST_F(AgentTest, ThePlannerSeesTheKeyFramesUnfiltered) {
  input_.key_frames = {{.points_W = wall(), .source = node_of_uav(UavIndex{0})},
                       {.points_W = {{1.0F, 2.0F, 3.0F}}, .source = Node{2}}};
  step();
  ASSERT_EQ(tape_.key_frames.size(), 2U);
  EXPECT_EQ(tape_.key_frames[0].points_W, wall()) << "nothing is left out, as it is on the map";
  EXPECT_EQ(tape_.key_frames[1].source, 2U);
  step();
  EXPECT_TRUE(tape_.key_frames.empty()) << "in the exchange in which they came, and no other";
}

TEST_F(AgentTest, APlannerThatAsksForScansGetsThem) {
  class Looker final : public Planner {
   public:
    PlannerOutput plan(const PlannerInput& in) override {
      return {.trigger = !in.scans.empty() && in.scans[0].tick == 40 && in.scans[0].points_W.size() == 2};
    }
    bool wants_scans() const override { return true; }
  };
  EXPECT_FALSE(agent_.wants_scans());
  Agent looker(fleet_of_three(), std::make_unique<Looker>());
  EXPECT_TRUE(looker.wants_scans());
  EXPECT_FALSE(looker.step(input_).trigger);
  input_.scans = {{.tick = 40, .points_W = {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}}}};
  EXPECT_TRUE(looker.step(input_).trigger);
}

TEST_F(AgentTest, APlannerThatAsksForTheWorldMapGetsIt) {
  struct Looker final : Planner {
    PlannerOutput plan(const PlannerInput& in) override {
      map = in.world_map;
      beam_scans = in.beam_scans.size();
      if (map != nullptr) above = map->at({0.0, 0.0, 14.0});
      return {};
    }
    bool wants_world_map() const override { return true; }
    const WorldMap* map = nullptr;
    std::size_t beam_scans = 0;
    Space above = Space::unknown;
  };
  for (const bool has_lidar : {true, false}) {
    auto planner = std::make_unique<Looker>();
    const Looker& looker = *planner;
    AgentConfig config = fleet_of_three();
    config.vehicle.lidar.reset();
    if (has_lidar) config.vehicle.lidar.emplace();
    Agent agent(config, std::move(planner));
    EXPECT_EQ(agent.wants_beams(), has_lidar);
    EXPECT_FALSE(agent.wants_scans());
    input_.state.p_WB = {0.0, 0.0, 10.0};
    for (int scan = 0; scan < 40; ++scan) {  // a servo that turns from side to side, and nothing to be seen
      input_.tick = 40 * scan;
      input_.scans = {{.tick = input_.tick}};
      input_.servos = {{input_.tick, 0.08 * (scan - 20), 0.8}};
      agent.step(input_);
    }
    ASSERT_NE(looker.map, nullptr);
    EXPECT_EQ(looker.beam_scans, 0U);
    EXPECT_EQ(looker.above, has_lidar ? Space::free : Space::unknown);
  }
}

TEST_F(AgentTest, APlannerThatAsksForBeamsGetsBeamsButNoScans) {
  class Looker final : public Planner {
   public:
    PlannerOutput plan(const PlannerInput& in) override {
      scans += in.scans.size();
      beam_scans.assign(in.beam_scans.begin(), in.beam_scans.end());
      return {};
    }
    bool wants_beams() const override { return true; }
    std::size_t scans = 0;
    std::vector<BeamScan> beam_scans;
  };
  EXPECT_FALSE(agent_.wants_beams());
  auto planner = std::make_unique<Looker>();
  const Looker& looker = *planner;
  AgentConfig config = fleet_of_three();
  config.vehicle.lidar.emplace();
  Agent agent(config, std::move(planner));
  EXPECT_TRUE(agent.wants_beams());
  EXPECT_FALSE(agent.wants_scans());
  input_.tick = 40;
  input_.scans = {{.tick = 40}};
  input_.servos = {{40, 0.5, 0.7}};
  agent.step(input_);
  ASSERT_EQ(looker.beam_scans.size(), 1U);
  EXPECT_EQ(looker.beam_scans[0].doubt, ScanDoubt::none);
  EXPECT_EQ(looker.beam_scans[0].tick, 40);
  input_.tick = 60;
  input_.servos.clear();
  agent.step(input_);
  EXPECT_EQ(agent.beam_scans(ScanDoubt::none), 2U) << "a scan may come an exchange later";
  input_.scans.clear();
  agent.step(input_);
  EXPECT_TRUE(looker.beam_scans.empty()) << "in the exchange in which they came, and no other";
  EXPECT_EQ(looker.scans, 0U) << "it asked for beams alone";
  EXPECT_EQ(agent.beam_scans(ScanDoubt::misfit) + agent.beam_scans(ScanDoubt::no_servo), 0U);
}

// The flight controller distinguishes modes by the fields that are zero, so the agent must not fill in, round or limit
// any field.
TEST_F(AgentTest, SendsCommandsOfItsPlannerUnchanged) {
  for (const TrajectoryCommand& own : {TrajectoryCommand{.v_WB = {9.0, -20.0, 0.5}, .yaw = 3.0, .yaw_rate = 0.4},
                                       TrajectoryCommand{.a_WB = {0.0, 0.0, 1e-3}}, TrajectoryCommand{.yaw = -2.0},
                                       TrajectoryCommand{.p_WB = {0.0, 0.0, 0.001}}, TrajectoryCommand{}}) {
    tape_.answer.motion = own;
    tape_.answer.yaw = 1.0;  // of no effect
    const auto command = step().trajectory;
    ASSERT_TRUE(command);
    EXPECT_EQ(command->p_WB, own.p_WB);
    EXPECT_EQ(command->v_WB, own.v_WB);
    EXPECT_EQ(command->a_WB, own.a_WB);
    EXPECT_EQ(command->yaw, own.yaw);
    EXPECT_EQ(command->yaw_rate, own.yaw_rate);
  }
  tape_.answer = {};
  EXPECT_FALSE(step().trajectory) << "without commands, the flight controller decides";
}

TEST_F(AgentTest, AfterCommandsOfThePlannerAPathBeginsWhereTheUavIs) {
  tape_.answer.motion = Path{{{{0.0, 0.0, 30.0}, 2.0}}};
  step();
  tape_.answer = {.motion = TrajectoryCommand{.v_WB = {4.0, 0.0, 0.0}}};
  for (int i = 1; i <= 40; ++i) {
    input_.state.p_WB = {0.2 * i, 0.0, 10.0};
    input_.state.v_WB = {4.0, 0.0, 0.0};
    input_.state.q_WB = Eigen::AngleAxisd(1.2, Vector3d::UnitZ());
    step();
    if (i == 1) continue;  // in the first exchange, the agent still follows the path
    EXPECT_EQ(tape_.tracking.setpoint.p_WB, input_.state.p_WB) << "a path begins where it is";
    EXPECT_TRUE(tape_.tracking.done) << "the path before is over";
  }
  EXPECT_TRUE(tape_.tracking.airborne);
  tape_.answer = {.motion = Path{{{{20.0, 0.0, 10.0}, 4.0}}}};
  Vector3d p_W = input_.state.p_WB, v_W = input_.state.v_WB;
  for (int i = 0; i < 200; ++i) {
    const auto command = step().trajectory;
    tape_.answer = {};
    ASSERT_TRUE(command);
    EXPECT_LT((command->p_WB - p_W).norm(), 4.2 * 0.05 + 0.05) << "no jump in position, exchange " << i;
    EXPECT_LT((command->v_WB - v_W).norm(), 4.0 * 0.05) << "no jump in velocity, exchange " << i;
    EXPECT_NEAR(command->yaw, 1.2, 1e-9) << "it looks where it looked";
    p_W = command->p_WB;
    v_W = command->v_WB;
    input_.state.p_WB = p_W;
    input_.state.v_WB = v_W;
  }
  EXPECT_NEAR((p_W - Vector3d(20.0, 0.0, 10.0)).norm(), 0.0, 1e-6);
}

TEST_F(AgentTest, AHoldAfterACommandOfThePlannerBrakes) {
  input_.state.v_WB = {3.0, 0.0, 0.0};
  tape_.answer.motion = TrajectoryCommand{.v_WB = {3.0, 0.0, 0.0}};
  step();
  tape_.answer.motion = Hold{};
  const auto first = step().trajectory;
  ASSERT_TRUE(first);
  EXPECT_NEAR((first->v_WB - Vector3d(3.0, 0.0, 0.0)).norm(), 0.0, 0.1) << "from the velocity that it has";
  tape_.answer = {};
  for (int i = 0; i < 100; ++i) {
    const auto command = step().trajectory;
    ASSERT_TRUE(command);
    input_.state.p_WB = command->p_WB;
    input_.state.v_WB = command->v_WB;
  }
  EXPECT_NEAR(input_.state.v_WB.norm(), 0.0, 1e-9);
  EXPECT_GT(input_.state.p_WB.x(), 0.5) << "it needs some distance to brake";
  EXPECT_LT(input_.state.p_WB.x(), 5.0);
}

TEST_F(AgentTest, AnAgentAddsTheMapsThatItHeardToItsOwn) {
  OccupancyMap other;
  other.insert({{30.2F, 0.2F, 10.2F}, {30.2F, 1.2F, 10.2F}}, std::nullopt);
  step();
  EXPECT_EQ(tape_.cells, 0U);
  tape_.answer.heard_maps = {other.octomap_bytes()};
  step();
  tape_.answer = {};
  step();
  EXPECT_EQ(tape_.cells, 2U);
}

TEST(AgentConfig, HoldsWhatAUavMayKnow) {
  Scenario scenario;
  scenario.fleet.resize(2);
  scenario.fleet[1].name = "changi";
  scenario.fleet[1].start = {3.0, 4.0};
  scenario.fleet[1].vehicle.role = Role::photographer;
  const AgentConfig config = agent_config(scenario, UavIndex{1});
  EXPECT_EQ(config.me().name, "changi");
  EXPECT_EQ(config.me().p_WB_start, Vector3d(3.0, 4.0, 0.0));
  EXPECT_NEAR(config.fleet[0].body_radius_m, 0.63, 1e-9);
  EXPECT_THROW(agent_config(scenario, UavIndex{2}), std::out_of_range);
}

}  // namespace
}  // namespace skein::agent
