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

}  // namespace
}  // namespace skein::cli
