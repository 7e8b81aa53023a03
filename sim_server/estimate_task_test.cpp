#include "sim_server/estimate_task.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

class Estimate : public ::testing::Test {
 protected:
  Estimate() {
    scenario_.fleet.resize(1);
    scenario_.fleet[0].start = {-20.0, 0.0};
    test::add_box(scene_.mesh, {5.0, 0.0, 5.0}, {2.0, 8.0, 8.0});
    scene_.points = {{{4.0F, 0.0F, 5.0F}, {-1.0F, 0.0F, 0.0F}}, {{6.0F, 1.0F, 4.0F}, {1.0F, 0.0F, 0.0F}}};
    request_.config.directions = 16;
  }

  Scenario scenario_;
  Scene scene_;
  OracleRequest request_;
};

TEST_F(Estimate, TheTaskReturnsTheAnswerOfTheOracleOnce) {
  EstimateTask task(scenario_, scene_, request_);
  std::optional<OracleSummary> taken;
  while (!taken) {
    taken = task.take();
    std::this_thread::yield();
  }
  EXPECT_EQ(*taken, *ask_oracle(scenario_, scene_, request_).summary);
  EXPECT_FALSE(task.take());
}

TEST_F(Estimate, TheTaskMayBeDestroyedWhileTheOracleComputes) {
  for (int i = 0; i < 5; ++i) EstimateTask(scenario_, scene_, request_);
}

TEST_F(Estimate, TheTaskHasNoAnswerIfTheOracleTakesTooLong) {
  request_.patience_s = 0.0;
  std::optional<EstimateTask> task(std::in_place, scenario_, scene_, request_);
  while (!task->over()) std::this_thread::yield();
  EXPECT_FALSE(task->take());
}

}  // namespace
}  // namespace skein::sim
