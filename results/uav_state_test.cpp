#include "results/uav_state.hpp"

#include <gtest/gtest.h>

namespace skein::results {
namespace {

TEST(UavState, NamesTheCauseThatTookAUavOutOfTheRun) {
  const Json faults = Json::parse(R"([
      {"kind": "kill", "target": "ada", "began_step": 20, "ended_step": null},
      {"kind": "kill", "target": "bob", "began_step": 20, "ended_step": 40},
      {"kind": "pause", "target": "cy", "began_step": 20, "ended_step": null},
      {"kind": "kill", "target": "dee", "began_step": null, "ended_step": null},
      {"kind": "blackout", "target": "eve", "began_step": 20, "ended_step": null}])");
  const auto state_of = [&](const char* name, bool alive = true, bool lost = false) {
    return uav_state({{"name", name}, {"alive", alive}, {"program_lost", lost}}, faults);
  };
  EXPECT_EQ(state_of("ada"), "killed");
  EXPECT_EQ(state_of("ada", false), "collided");
  EXPECT_EQ(state_of("bob"), "alive") << "its program is back";
  EXPECT_EQ(state_of("bob", true, true), "lost");
  EXPECT_EQ(state_of("cy"), "paused");
  EXPECT_EQ(state_of("dee"), "alive") << "the run ended before the fault";
  EXPECT_EQ(state_of("eve"), "alive");
  EXPECT_EQ(uav_state({{"name", "ada"}}, faults), "-");
  EXPECT_EQ(uav_state({{"name", "bob"}, {"alive", true}}, nullptr), "alive");
}

}  // namespace
}  // namespace skein::results
