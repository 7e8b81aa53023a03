// Figures that are written as JSON and read back are the same, bit for bit.
#include "cli/study/figures_json.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::cli {
namespace {

/// A result without some random keys.
Json drawn_result(RandomStream& draw) {
  Json result = {{"status", "completed"}, {"digest", "abc"}, {"collisions", Json::array()}};
  const auto maybe = [&](Json& object, const char* key, double value) {
    if (draw.uniform() < 0.8) object[key] = value;
  };
  for (const char* key :
       {"score", "points_detected", "points_total", "real_time_factor", "mission_time_s", "sim_time_s", "memory_mb"}) {
    maybe(result, key, draw.uniform(0.0, 1e4));
  }
  Json attainable = Json::object(), check = Json::object(), scores = Json::object();
  maybe(attainable, "score", draw.uniform(1.0, 500.0));
  for (const char* key : {"braking_hits", "braking_meets", "ways_meet", "least_clearance_m", "least_separation_m"}) {
    maybe(check, key, draw.uniform(-1.0, 9.0));
  }
  Json uavs = Json::array();
  for (const char* name : {"jurong", "a \"quoted\", one"}) {
    Json uav = {{"name", name}, {"role", draw.uniform() < 0.5 ? "explorer" : "photographer"}};
    for (const char* key :
         {"idle_s", "frozen_s", "excused_s", "waited_s", "without_work_s", "distance_m", "planner_cpu_s", "captures"}) {
      maybe(uav, key, draw.uniform(0.0, 1.0 / 3.0));
    }
    maybe(scores, name, draw.uniform(0.0, 99.0));
    uavs.push_back(uav);
  }
  Json losses = Json::object();
  for (const char* cause : {"drift", "never_in_picture", "below_threshold"}) {
    if (draw.uniform() < 0.8) losses[cause] = {{"points", 3}, {"score", draw.uniform(-1.0, 99.0)}};
  }
  if (losses.contains("below_threshold") && draw.uniform() < 0.5)
    losses["below_threshold"]["by_part"] = {{"tilt", {{"points", 2}, {"score", draw.uniform(0.0, 9.0)}}}};
  result["losses"] = losses;
  result["attainable"] = attainable;
  result["flight_check"] = check;
  result["score_by_uav"] = scores;
  result["uavs"] = uavs;
  return result;
}

TEST(FiguresJson, AreTheSameWhenReadBack) {
  RandomStream draw(1, "figures", 0);
  for (int i = 0; i < 200; ++i) {
    const FlightFigures figures = figures_of(drawn_result(draw));
    const Json written = to_json(figures), read = parse_json(written.dump());
    const FlightFigures again = figures_from(read);
    EXPECT_EQ(to_json(again), written);
    EXPECT_EQ(again.score, figures.score);
    EXPECT_EQ(again.attainable_percent, figures.attainable_percent);
    EXPECT_EQ(again.frozen_uavs, figures.frozen_uavs);
    EXPECT_EQ(again.least_clearance_m, figures.least_clearance_m);
    EXPECT_EQ(again.losses, figures.losses);
    EXPECT_EQ(again.poor_parts, figures.poor_parts);
    EXPECT_EQ(again.planner_cpu_ms, figures.planner_cpu_ms);
    ASSERT_EQ(again.uavs.size(), 2U);
    EXPECT_EQ(again.uavs[1].name, figures.uavs[1].name);
    EXPECT_EQ(again.uavs[1].idle_s, figures.uavs[1].idle_s);
  }
}

TEST(FiguresJson, DamagedFiguresAreReadAsEmpty) {
  for (const char* text : {"null", "3", "{\"score\": \"x\", \"uavs\": 3}", "{\"uavs\": [3]}", "{\"status\": 7}"}) {
    EXPECT_EQ(figures_from(parse_json(text)).score, 0.0) << text;
  }
}

}  // namespace
}  // namespace skein::cli
