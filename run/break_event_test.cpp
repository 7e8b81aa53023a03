#include "run/break_event.hpp"

#include <gtest/gtest.h>

namespace skein::cli {
namespace {

const Json kResult = Json::parse(R"({
  "exchange_period_s": 0.05,
  "collisions": [{"uav": "a", "with": "structure", "time_s": 9.5}, {"uav": "b", "with": "a", "time_s": 7.25},
                 {"uav": "b", "with": "ground"}],
  "lost_members": [{"member": "a", "time_s": 4.0}, {"member": "station", "time_s": 2.0}],
  "uavs": [{"name": "a", "first_rejected_s": 12.3}, {"name": "b", "first_rejected_s": null}],
  "faults": [{"target": "a", "began_step": null}, {"target": "a", "began_step": 80}, {"target": "b", "began_step": 60}]
})");

TEST(BreakEvent, TheFirstEventOfAUavCounts) {
  EXPECT_EQ(event_time_s(kResult, "a", "collision"), 7.25) << "a collision also counts for the UAV that was hit";
  EXPECT_NEAR(event_time_s(kResult, "a", "lost").value(), 4.025, 1e-9) << "between its exchange and the next";
  EXPECT_NEAR(event_time_s(kResult, "station", "lost").value(), 2.025, 1e-9);
  EXPECT_EQ(event_time_s(kResult, "a", "fault"), 4.0);
  EXPECT_EQ(event_time_s(kResult, "b", "fault"), 3.0);
  EXPECT_NEAR(event_time_s(kResult, "a", "rejected").value(), 12.325, 1e-9) << "between its exchange and the next";
}

TEST(BreakEvent, AnEventThatNeverHappenedHasNoTime) {
  EXPECT_EQ(event_time_s(kResult, "b", "lost"), std::nullopt);
  EXPECT_EQ(event_time_s(kResult, "b", "rejected"), std::nullopt);
  for (const char* what : kBreakEvents) {
    EXPECT_EQ(event_time_s(kResult, "c", what), std::nullopt);
    EXPECT_EQ(event_time_s(Json::object(), "a", what), std::nullopt);
    EXPECT_EQ(event_time_s(nullptr, "a", what), std::nullopt) << "there was no result";
  }
}

TEST(BreakEvent, ARunWithAnotherInputIsNotTheSameFlight) {
  FleetPlan plan{{}, {}, {}, {}, {}};
  plan.options.scenario = "towers";
  plan.options.seed = 7;
  plan.scenario.scene.scene_seed = 3;
  plan.scenario.fleet.resize(2);
  plan.scenario.fleet[0].name = "a";
  plan.scenario.fleet[1].name = "b";
  plan.scenario.rules.preset = "paper";
  plan.planners = {{"a", "kios"}, {"b", "hover"}};
  plan.faults.faults = {{.at_s = 2.5, .until_s = 4.0, .action = Kill{"a"}},
                        {.at_s = 1.0, .until_s = {}, .action = Blackout{"b"}, .when = FaultCondition{"score > 1"}}};
  const Json same = Json::parse(R"({
    "scenario": "towers", "seed": 7, "scene_seed": 3, "rules": "paper", "uavs": [{"name": "a"}, {"name": "b"}],
    "planner": {"a": "kios", "b": "hover", "gcs": "kios"},
    "faults": [{"kind": "kill", "target": "a", "at_s": 2.5, "until_s": 4.0},
               {"kind": "blackout", "target": "b", "at_s": 9.75, "until_s": null, "when": "score > 1"}]
  })");
  EXPECT_EQ(other_input(same, plan), "");
  const auto other = [&](const char* key, const char* value) {
    Json result = same;
    result[key] = Json::parse(value);
    return other_input(result, plan);
  };
  EXPECT_EQ(other("scenario", R"("hangar")"), "another scenario");
  EXPECT_EQ(other("seed", "8"), "another seed");
  EXPECT_EQ(other("scene_seed", "4"), "another scene seed");
  EXPECT_EQ(other("uavs", R"([{"name": "a"}, {"name": "b"}, {"name": "c"}])"), "another fleet");
  EXPECT_EQ(other("planner", R"({"a": "kios", "b": "patrol"})"), "another planner of b");
  EXPECT_EQ(other("rules", R"("contest")"), "other rules");
  EXPECT_EQ(other("conditions", R"("breezy")"), "other conditions");
  EXPECT_EQ(other("faults", "[]"), "other faults");
  Json late = same;
  late["faults"][0]["at_s"] = 2.6;
  EXPECT_EQ(other_input(late, plan), "other faults");
}

}  // namespace
}  // namespace skein::cli
