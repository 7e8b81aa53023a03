// Modes of the trajectory controller; its numbers are checked by sim_server/golden/check_test.cpp.
#include "sim_server/flight/position_control.hpp"

#include <gtest/gtest.h>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

RigidBodyState hovering(const Vector3d& p_W) {
  RigidBodyState state;
  state.p_WB = p_W;
  return state;
}

TrajectoryCommand go_to(const Vector3d& p_W) {
  TrajectoryCommand command;
  command.p_WB = p_W;
  return command;
}

TEST(PositionController, ThereIsNoThrustBeforeTheFirstCommand) {
  PositionController controller({});
  for (Tick age : {0, 20, 40, 400, 4000}) {
    EXPECT_EQ(controller.step(hovering({1, 2, 0.2}), {}, age).thrust_N, 0.0);
    EXPECT_EQ(controller.memory().mode, ControlMode::idle);
  }
  EXPECT_GT(controller.step(hovering({1, 2, 0.2}), go_to({1, 2, 3}), 0).thrust_N, 30.0);
  EXPECT_EQ(controller.memory().mode, ControlMode::moving);
}

TEST(PositionController, TheUavHoldsThePositionAtWhichTheCommandLapsed) {
  PositionController controller({});
  controller.step(hovering({1, 2, 5}), go_to({9, 2, 5}), 0);
  controller.step(hovering({1.5, 2, 5}), {}, PositionController::kMaxAge);
  EXPECT_EQ(controller.memory().mode, ControlMode::moving);
  controller.step(hovering({2, 2, 5}), {}, PositionController::kMaxAge + 20);
  controller.step(hovering({3, 2, 5}), {}, PositionController::kMaxAge + 40);
  EXPECT_EQ(controller.memory().mode, ControlMode::hold);
  EXPECT_EQ(controller.memory().command.p_WB, Vector3d(2, 2, 5));
  controller.step(hovering({3, 2, 5}), go_to({9, 2, 5}), 0);
  EXPECT_EQ(controller.memory().mode, ControlMode::moving);
}

TEST(PositionController, AnAllZeroCommandMeansStayAndTurn) {
  PositionController controller({});
  TrajectoryCommand turn;
  turn.yaw = 1.0;
  const ControlDemand demand = controller.step(hovering({4, 5, 6}), turn, 0);
  EXPECT_EQ(controller.memory().mode, ControlMode::yaw_only);
  EXPECT_EQ(controller.memory().command.p_WB, Vector3d(4, 5, 6));
  EXPECT_GT(demand.yaw_rate, 1.0);
}

TEST(PositionController, AStopIsPermanent) {
  PositionController controller({});
  controller.step(hovering({1, 2, 5}), go_to({9, 2, 5}), 0);
  controller.stop();
  const ControlDemand demand = controller.step(hovering({1, 2, 5}), go_to({9, 2, 5}), 0);
  EXPECT_EQ(demand.thrust_N, 0.0);
  EXPECT_EQ(demand.roll, 0.0);
  EXPECT_EQ(demand.yaw_rate, 0.0);
}

TEST(PositionController, TheDemandStaysWithinItsLimits) {
  PositionController controller({});
  for (int i = 0; i < 300; ++i) {
    RigidBodyState state = hovering({50.0 * std::sin(i), 50.0 * std::cos(2.0 * i), 20.0 + 15.0 * std::sin(3.0 * i)});
    state.q_WB = Quaterniond(rotation_z(0.7 * i) * rotation_y(0.4 * std::sin(5.0 * i)));
    state.v_WB = {5.0 * std::sin(7.0 * i), 5.0 * std::cos(i), std::sin(i)};
    TrajectoryCommand command = go_to({-10, 20, 8});
    command.yaw = 3.0 * std::sin(11.0 * i);
    const ControlDemand demand = controller.step(state, command, 0);
    EXPECT_LE(std::abs(demand.roll), 45.0 * kRadPerDeg + 1e-12);
    EXPECT_LE(std::abs(demand.pitch), 45.0 * kRadPerDeg + 1e-12);
    EXPECT_LE(std::abs(demand.yaw_rate), 90.0 * kRadPerDeg + 1e-12);
    const auto& memory = controller.memory();
    EXPECT_LE(memory.position_error_sum.cwiseAbs().maxCoeff(), 10.0);
    EXPECT_LE(std::abs(memory.yaw_error_sum), 1.57);
  }
}

}  // namespace
}  // namespace skein::sim
