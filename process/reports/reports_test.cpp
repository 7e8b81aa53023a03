// The format of the programs' reports is a contract. A whole report is read back unchanged. Of a damaged report, the
// intact values are read.
#include "process/reports/reports.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace skein {
namespace {

const char* const kSimServer = R"({
  "collisions": [{"position": [1.0, 2.0, 3.5], "time_s": 4.5, "uav": "alpha", "with": "structure"}],
  "deterministic": false, "digest": null,
  "faults": [{"at_s": 1.0, "began_step": 20, "ended_step": null, "kind": "kill", "target": "alpha", "until_s": null}],
  "flight": {"clock": "realtime:2", "dds": "fastdds", "duration_s": 30.0, "run": 7, "scenario": "towers", "scene_seed": 1, "seed": 2, "uavs": 3},
  "flight_check": {"braking_hits": 2, "braking_meets": 1, "exchanges": 900,
    "first": [{"distance_m": -0.25, "position": [4.0, 5.0, 6.5], "time_s": 12.5, "uav": "alpha", "with": "structure"}],
    "least_braking_clearance_m": -0.25, "least_braking_separation_m": 0.5, "least_clearance_m": 0.125, "least_separation_m": 1.5,
    "tracking_by_speed": [{"from_mps": 1.0, "max": 0.5, "p50": 0.125, "p99": 0.25, "p9999": 0.375, "samples": 800}],
    "tracking_error_m": {"max": 0.5, "p50": 0.125, "p99": 0.25, "p9999": 0.375, "samples": 900}, "ways_meet": 3},
  "lost_members": [{"back_at_s": 8.25, "member": "beta", "reason": "died", "step": 12, "time_s": 0.6}],
  "malformed": 0, "mission_time_s": 600.0,
  "points_poor": [{"index": 1, "q": 0.125, "q_blur": 0.25, "q_distance": 0.75, "q_res": 0.5}], "points_seen": "101", "points_total": 3, "rules": "caric", "sim_time_s": 650.5,
  "status": "no_takeoff",
  "timing": {"camera_s": 0.1, "cpu_s": 1.0, "exposures": 3, "lidar_ms_per_scan": 0.25, "lidar_s": 0.2, "links_s": 0.3,
             "physics_s": 0.4, "recording_s": 0.5, "scans": 4, "steps": 5},
  "uavs": [{"alive": false, "captures": 7, "commands_rejected": 1, "commands_unheard": 2, "distance_m": 10.5,
            "first_rejected_s": 3.25, "idle_s": 2.0, "max_speed_mps": 4.0, "name": "alpha", "role": "explorer",
            "work": {"done": [0.0, 0.25], "open": "-1"}}],
  "unsent": 0, "unwritten": ["x: full"], "wall_time_s": 13.0, "warnings": ["windy"]})";

const char* const kStation = R"({
  "points_detected": 2, "score": 1.5, "score_earned": 1.75, "score_by_uav": {"beta": 1.5, "alpha": 0.0},
  "points": [{"index": 2, "score": 0.8999999761581421, "uav": "beta", "capture": 1}],
  "refused": {"unknown": 1, "borrowed": 2, "altered": 3}, "reports_received": 5, "duplicates": 1, "dds": "fastdds", "malformed": 0, "unsent": 2,
  "unwritten": []})";

const char* const kRouter = R"({
  "dds": "cyclonedds", "corrupted": 2, "delivered": 7, "delivered_bytes": 280, "dropped_fault": 1, "dropped_no_los": 2, "dropped_overflow": 3,
  "duplicated": 4, "malformed": 0,
  "per_link": [{"corrupted": 1, "delivered": 7, "delivered_bytes": 280, "dropped_fault": 1, "dropped_no_los": 2, "dropped_overflow": 0,
                "duplicated": 0, "from": "alpha", "sent": 10, "sent_bytes": 400, "to": "gcs"}],
  "sent": 10, "sent_bytes": 400, "unheard": 0, "unsent": 0, "unwritten": [], "warnings": ["who is that?"]})";

const char* const kAgent = R"({
  "dds": "cyclonedds",
  "from_nodes": [{"handed_on": 8, "late": 1, "lost": 2, "other_clock": 3, "received": 11, "refused": 4, "topic": "/plan"}], "malformed": 0, "no_way": ["3 times: walled in"], "planner": "kios:voxel=4", "planner_cpu_max_ms": 60.25, "planner_cpu_p99_ms": 1.5, "planner_cpu_s": 0.25,
  "planner_exchanges_over_50ms": 3, "planner_parts": [{"cpu_s": 0.125, "part": "planner/views"}],
  "safety_filter": {"breaches": 2, "slowed": 30, "steps": 400}, "unsent": 0,
  "waited_s": 12.5,
  "waits": [{"from_s": 1.5, "uav": "alpha", "until_s": 3.0}]})";

/// Calls `check` with the place of each value in `json`.
void for_each_place(const Json& json, const Json::json_pointer& here, const auto& check) {
  if (!here.empty()) check(here);
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    for_each_place(value, json.is_array() ? here / static_cast<std::size_t>(std::stoul(key)) : here / key, check);
  }
}

void erase(Json& json, const Json::json_pointer& place) {
  Json& parent = json[place.parent_pointer()];
  if (parent.is_array()) {
    parent.erase(std::stoul(place.back()));
  } else {
    parent.erase(place.back());
  }
}

template <class Report>
void check_report(const char* text) {
  const Json whole = Json::parse(text);
  EXPECT_EQ(json_of(struct_of<Report>(whole)).dump(), whole.dump());
  EXPECT_EQ(json_of(struct_of<Report>(Json())), json_of(Report{}));
  for_each_place(whole, Json::json_pointer(), [&](const Json::json_pointer& place) {
    for (const Json& odd : {Json(nullptr), Json("odd"), Json(-1), Json(1e300), Json::array({1}), Json::object()}) {
      Json damaged = whole;
      damaged[place] = odd;
      EXPECT_NO_THROW(struct_of<Report>(damaged)) << place;
    }
    if (place.to_string().find("/position/") != std::string::npos) return;  // a position of two numbers is not read
    Json lacking = whole;
    erase(lacking, place);
    const Json read = json_of(struct_of<Report>(lacking));
    for_each_place(lacking, Json::json_pointer(), [&](const Json::json_pointer& other) {
      if (lacking[other].is_structured()) return;
      EXPECT_EQ(read.contains(other) ? read[other] : Json("missing"), lacking[other]) << other << " without " << place;
    });
  });
}

TEST(Reports, TheServersReportIsReadBack) { check_report<SimServerReport>(kSimServer); }
TEST(Reports, TheStationsReportIsReadBack) { check_report<StationReport>(kStation); }
TEST(Reports, TheRoutersReportIsReadBack) { check_report<RouterReport>(kRouter); }
TEST(Reports, AnAgentsReportIsReadBack) { check_report<AgentReport>(kAgent); }

TEST(Reports, KeysThatAnEntryLacksStayAbsent) {
  const auto report = struct_of<SimServerReport>(parse_json(R"({"collisions": [{"uav": "alpha"}], "uavs": [{}]})"));
  EXPECT_EQ(json_of(report.collisions), Json::parse(R"([{"uav": "alpha"}])"));
  EXPECT_EQ(json_of(report.uavs), Json::parse("[{}]"));
  EXPECT_EQ(json_of(report.timing), Json::object());
}

TEST(Reports, TheListOfStrategiesIsReadBack) {
  const StrategyList list{{"hover", "patrol"}, {"star"}};
  const std::string text = json_of(list).dump();
  EXPECT_EQ(text, R"({"planners":["hover","patrol"],"ground_programs":["star"]})");
  EXPECT_EQ(json_of(struct_of<StrategyList>(parse_json(text))).dump(), text);
}

}  // namespace
}  // namespace skein
