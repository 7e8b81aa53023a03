// The on-board software as a whole, with a planner that only records what it is told.
#include "uav_agent/agent.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::agent {
namespace {

/// What the planner saw in the last exchange, and what it shall answer.
struct Tape {
  std::size_t boxes = 0, undelivered = 0, cells = 0;
  bool station_linked = false, near_is_free = false;
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

TEST_F(AgentTest, SaysNothingUntilItsPlannerDoes) {
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
    ASSERT_TRUE(output.trajectory) << "the controller holds after 0.1 s without";
    ASSERT_TRUE(output.gimbal);
    EXPECT_EQ(output.gimbal->pitch, 0.3);
    input_.state.p_WB = output.trajectory->p_WB;
  }
  EXPECT_EQ(tape_.boxes, 3U);
  EXPECT_NEAR(input_.state.p_WB.z(), 20.0, 1e-6);
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

TEST_F(AgentTest, AnUnseenPeerIsStillWhereItStood) {
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
  const Neighbour first{node_of_uav(1), {0.0, 0.0, 10.0}}, second{node_of_uav(2), {0.0, 5.0, 10.0}};
  input_.state.p_WB = {0.0, -30.0, 10.0};
  input_.key_frames = {{.points_W = wall()}};
  step();
  EXPECT_FALSE(tape_.near_is_free) << "nobody with a LiDAR is linked";
  input_.neighbours = {first, second};
  input_.key_frames = {{.points_W = wall()}};
  step();
  EXPECT_TRUE(tape_.near_is_free) << "only one of the linked UAVs has a LiDAR";
}

TEST_F(AgentTest, AKeyFramesSourceCounts) {
  input_.neighbours = {{node_of_uav(1), {0.0, 0.0, 30.0}}};
  input_.key_frames = {{.points_W = wall(), .source = node_of_uav(0)}};
  step();
  EXPECT_TRUE(tape_.near_is_free) << "its own: seen from where it is";
}

TEST_F(AgentTest, DeliversThroughTheDirectLinkOnly) {
  input_.capture_reports = {{0, {1, 2, 3}}, {1, {4}}};
  EXPECT_TRUE(step().captures.empty());
  EXPECT_EQ(tape_.undelivered, 2U);
  input_.neighbours = {{kStationNode, {0.0, 0.0, 0.3}}};
  const auto sent = step().captures;
  EXPECT_TRUE(tape_.station_linked);
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[0].payload, (std::vector<std::uint8_t>{1, 2, 3}));
  input_.capture_acks = {0, 1};
  step();
  EXPECT_EQ(tape_.undelivered, 0U);
}

TEST(AgentConfig, HoldsWhatAUavMayKnow) {
  Scenario scenario;
  scenario.fleet.resize(2);
  scenario.fleet[1].name = "changi";
  scenario.fleet[1].start = {3.0, 4.0};
  scenario.fleet[1].vehicle.role = Role::photographer;
  const AgentConfig config = agent_config(scenario, 1);
  EXPECT_EQ(config.me().name, "changi");
  EXPECT_EQ(config.me().p_WB_start, Vector3d(3.0, 4.0, 0.0));
  EXPECT_NEAR(config.fleet[0].body_radius_m, 0.63, 1e-9);
  EXPECT_THROW(agent_config(scenario, 2), std::out_of_range);
}

}  // namespace
}  // namespace skein::agent
