#include "results/result.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "results/testing/scratch.hpp"
#include "tests/support/places.hpp"

namespace skein::results {
namespace {

bool has_type(const Json& value, const std::string& type) {
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "array") return value.is_array();
  if (type == "object") return value.is_object();
  return type == "null" && value.is_null();
}

/// Validates a value with the part of JSON Schema that result.schema.json uses. Every key must be described. Adds an
/// entry for each error.
void validate(const Json& value, const Json& schema, const std::string& path, std::vector<std::string>& errors) {
  const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
  const auto matches = [&](const Json& type) { return has_type(value, type); };
  if (std::none_of(types.begin(), types.end(), matches)) return errors.push_back(path + ": is " + value.dump());
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
    errors.push_back(path + ": is not among the names: " + value.dump());
  }
  if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
    errors.push_back(path + ": too small");
  if (value.is_array() && schema.contains("minItems") && value.size() < schema["minItems"])
    errors.push_back(path + ": short");
  if (value.is_array() && schema.contains("items")) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      validate(value[i], schema["items"], path + "[" + std::to_string(i) + "]", errors);
    }
  }
  if (!value.is_object()) return;
  for (const Json& key : schema.value("required", Json::array())) {
    if (!value.contains(key.get<std::string>())) errors.push_back(path + ": lacks " + key.get<std::string>());
  }
  const Json properties = schema.value("properties", Json::object());
  for (const auto& [key, entry] : value.items()) {
    if (properties.contains(key)) {
      validate(entry, properties[key], path + "." + key, errors);
    } else if (schema.contains("additionalProperties")) {
      validate(entry, schema["additionalProperties"], path + "." + key, errors);
    } else if (schema.contains("properties")) {
      errors.push_back(path + "." + key + ": the schema does not know it");
    }
  }
}

std::vector<std::string> schema_errors(const Json& result) {
  std::vector<std::string> errors;
  validate(result, read_json(source_path("docs/result.schema.json")), "result", errors);
  return errors;
}

class RunResult : public ::testing::Test {
 protected:
  RunResult() {
    scenario_.name = "small";
    for (const auto& [name, role] : {std::pair("alpha", Role::explorer), std::pair("beta", Role::photographer)}) {
      UavConfig uav;
      uav.name = name;
      uav.vehicle.role = role;
      scenario_.fleet.push_back(uav);
    }
    facts_.scenario = "small";
    facts_.planners = {{"alpha", "patrol"}, {"beta", "hover"}};
    facts_.dds = {{"sim_server", "cyclonedds"}, {"station", "fastdds"}};
    facts_.clock = "lockstep";
  }

  void write_all_reports() const {
    write_text(dir_.path() / "sim_server.report.json", R"({
      "status": "completed", "deterministic": true, "digest": "00ff", "sim_time_s": 650.5, "mission_time_s": 600,
      "wall_time_s": 13.01, "rules": {"preset": "contest"}, "points_total": 3,
      "collisions": [{"time_s": 4.5, "uav": "alpha", "with": "structure", "position": [1, 2, 3]}],
      "uavs": [{"name": "alpha", "role": "explorer", "alive": false, "distance_m": 10.5, "max_speed_mps": 4,
                "captures": 7, "idle_s": 2, "commands_rejected": 1},
               {"name": "beta", "role": "photographer", "alive": true, "distance_m": 20, "max_speed_mps": 3.5,
                "captures": 9, "idle_s": 1.5, "commands_rejected": 0}],
      "lost_members": [{"member": "beta", "step": 12, "time_s": 0.6, "reason": "died"}], "warnings": ["windy"],
      "timing": {}})");
    write_text(dir_.path() / "station.report.json", R"({
      "points_detected": 2, "score": 1.5, "score_earned": 1.75, "score_by_uav": {"beta": 1.5},
      "points": [{"index": 0, "score": 0.5, "uav": "beta", "capture": 1},
                 {"index": 2, "score": 1.0, "uav": "beta", "capture": 2}], "refused": {}})");
    write_text(dir_.path() / "comm_router.report.json", R"({
      "sent": 10, "delivered": 7, "dropped_no_los": 2, "dropped_fault": 1, "sent_bytes": 400, "delivered_bytes": 280,
      "per_link": [{"from": "alpha", "to": "gcs", "sent": 10, "delivered": 7, "dropped_no_los": 2, "dropped_fault": 1,
                    "sent_bytes": 400, "delivered_bytes": 280}]})");
    for (const char* uav : {"alpha", "beta"}) {
      write_text(dir_.path() / (std::string("uav_agent-") + uav + ".report.json"), R"({
        "planner_cpu_s": 0.25, "planner_cpu_p99_ms": 1.5, "planner_cpu_max_ms": 60.25,
        "planner_exchanges_over_50ms": 3, "planner_parts": [{"cpu_s": 0.125, "part": "planner/views"}],
        "safety_filter": {"steps": 400, "slowed": 30, "breaches": 2}})");
    }
  }

  Json merged() const { return merge_result(facts_, scenario_, read_reports(dir_.path(), scenario_)); }

  Scratch dir_;
  Scenario scenario_;
  RunFacts facts_;
};

TEST_F(RunResult, AllReportsTogetherGiveACompleteResult) {
  write_all_reports();
  const Json result = merged();
  EXPECT_EQ(schema_errors(result), std::vector<std::string>{});
  EXPECT_EQ(result["status"], "completed");
  EXPECT_EQ(result["digest"], "00ff");
  EXPECT_DOUBLE_EQ(result["real_time_factor"], 50.0);
  EXPECT_EQ(result["planner"]["beta"], "hover");
  EXPECT_EQ(result["score"], 1.5);
  EXPECT_EQ(result["score_by_uav"], (Json{{"alpha", 0.0}, {"beta", 1.5}}));
  EXPECT_EQ(result["uavs"][0]["alive"], false);
  EXPECT_EQ(result["uavs"][0]["program_lost"], false);
  EXPECT_EQ(result["uavs"][1]["program_lost"], true);
  EXPECT_EQ(result["uavs"][1]["captures"], 9);
  EXPECT_EQ(result["uavs"][1]["planner_cpu_s"], 0.25);
  EXPECT_EQ(result["uavs"][1]["planner_cpu_p99_ms"], 1.5);
  EXPECT_EQ(result["uavs"][1]["planner_cpu_max_ms"], 60.25);
  EXPECT_EQ(result["uavs"][1]["planner_exchanges_over_50ms"], 3);
  EXPECT_EQ(result["uavs"][1]["planner_parts"][0]["part"], "planner/views");
  EXPECT_EQ(result["uavs"][1]["planner_parts"][0]["cpu_s"], 0.125);
  for (const auto& [key, count] : {std::pair("steps", 400), {"slowed", 30}, {"breaches", 2}}) {
    EXPECT_EQ(result["uavs"][1]["safety_filter"][key], count);
  }
  EXPECT_EQ(result["radio"]["sent_bytes"], 400);
  EXPECT_EQ(result["radio"]["delivered_bytes"], 280);
  EXPECT_EQ(result["radio"]["per_link"][0]["to"], "gcs");
  EXPECT_EQ(result["lost_members"][0]["member"], "beta");
  EXPECT_EQ(result["warnings"], Json::array({"windy"}));
}

TEST_F(RunResult, SwitchesThatDifferFromThePresetAreReported) {
  write_all_reports();
  EXPECT_EQ(merged()["rule_switches"], Json::object());
  scenario_.rules.min_point_score = 0.25;
  scenario_.rules.own_body_hides = false;
  const Json result = merged();
  EXPECT_EQ(result["rule_switches"], (Json{{"own_body_hides", false}, {"min_point_score", 0.25}}));
  EXPECT_EQ(schema_errors(result), std::vector<std::string>{});
}

TEST_F(RunResult, APlanInTheEstimateMustHaveTheScoreOfItsFlight) {
  Json result = merged();
  result["attainable"] = {{"points", 9}, {"score", 8.5}, {"plan", {{"points", 7}, {"score", 6.0}}}};
  EXPECT_EQ(schema_errors(result).size(), 1u) << "the score of the plan's flight is missing";
  result["attainable"]["plan"]["flown_score"] = 6.25;
  EXPECT_EQ(schema_errors(result), std::vector<std::string>{});
}

TEST_F(RunResult, MemoryIsTheSumOfTheProcesses) {
  facts_.processes = {{"sim_server", {2.5, 100.0}}, {"station", {0.25, 50.0}}};
  const Json result = merged();
  EXPECT_EQ(schema_errors(result), std::vector<std::string>{});
  EXPECT_EQ(result["memory_mb"], 150.0);
  EXPECT_EQ(result["processes"]["sim_server"]["cpu_s"], 2.5);
}

TEST_F(RunResult, WithoutReportsTheResultIsAbortedAndHasTheLastKnownNumbers) {
  facts_.sim_time_s = 20.0;
  facts_.wall_time_s = 2.0;
  facts_.score = 3.25;
  facts_.points_detected = 4;
  const Json result = merged();
  EXPECT_EQ(schema_errors(result), std::vector<std::string>{});
  EXPECT_EQ(result["status"], "aborted");
  EXPECT_EQ(result["deterministic"], false);
  EXPECT_TRUE(result["digest"].is_null());
  EXPECT_EQ(result["sim_time_s"], 20.0);
  EXPECT_EQ(result["real_time_factor"], 10.0);
  EXPECT_EQ(result["score"], 3.25);
  EXPECT_EQ(result["points_detected"], 4);
  EXPECT_EQ(result["uavs"][0]["name"], "alpha");
  EXPECT_TRUE(result["uavs"][0]["alive"].is_null());
  EXPECT_EQ(result["warnings"].size(), 5u) << result["warnings"];
}

TEST_F(RunResult, AMissingReportDoesNotAffectTheOthers) {
  for (const char* missing : {"sim_server", "station", "comm_router", "uav_agent-alpha"}) {
    write_all_reports();
    std::filesystem::remove(dir_.path() / (std::string(missing) + ".report.json"));
    const Json result = merged();
    EXPECT_EQ(schema_errors(result), std::vector<std::string>{}) << missing;
    EXPECT_NE(result["warnings"].dump().find(std::string(missing) + " left no report"), std::string::npos) << missing;
  }
}

TEST_F(RunResult, PlannersHaveTheSyntaxOfTheCommandLine) {
  facts_.planners = {{"alpha", "orbit:x=1", "/teams/a"}, {"beta", "hover"}};
  facts_.ground_program = UavPlanner{"gcs", "orbit", "/teams/b"};
  EXPECT_EQ(merged()["planner"], (Json{{"alpha", "orbit:x=1@/teams/a"}, {"beta", "hover"}, {"gcs", "orbit@/teams/b"}}));
}

TEST_F(RunResult, AProgramOfTheUsersOwnNeedsNoReport) {
  write_all_reports();
  for (const char* uav : {"alpha", "beta"}) {
    std::filesystem::remove(dir_.path() / (std::string("uav_agent-") + uav + ".report.json"));
  }
  facts_.planners = {{"alpha", "exec:./mine --fast"}, {"beta", "hover"}};
  const std::string warnings = merged()["warnings"].dump();
  EXPECT_EQ(warnings.find("uav_agent-alpha"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("uav_agent-beta left no report"), std::string::npos) << warnings;
}

TEST_F(RunResult, AReportCutShortOrOfWrongTypesCountsAsMissing) {
  write_all_reports();
  write_text(dir_.path() / "station.report.json", R"({"points_detected": 2, "sco)");
  write_text(dir_.path() / "sim_server.report.json", R"({"status": 7, "digest": null, "uavs": [3], "collisions": {}})");
  write_text(dir_.path() / "comm_router.report.json", "[]");
  EXPECT_EQ(schema_errors(merged()), std::vector<std::string>{});
}

TEST_F(RunResult, AnInterruptedRunWithoutReportsHasTheStatusInterrupted) {
  facts_.interrupted = true;
  EXPECT_EQ(merged()["status"], "interrupted");
}

TEST_F(RunResult, ScoreCsvHasAllPointsInOrder) {
  EXPECT_FALSE(write_score_csv(dir_.path(), std::nullopt));
  write_all_reports();
  write_text(dir_.path() / "scene.json",
             R"({"boxes": [], "points": [[1, 2, 3, 0, 0, 1], [4.5, 5, 6, 1, 0, 0], [7, 8, 9, 0, 1, 0]]})");
  EXPECT_TRUE(write_score_csv(dir_.path(), read_reports(dir_.path(), scenario_).station));
  EXPECT_EQ(read_text(dir_.path() / "score.csv"),
            "x,y,z,nx,ny,nz,score,index\n"
            "1,2,3,0,0,1,0.5,0\n"
            "4.5,5,6,1,0,0,0.0,1\n"
            "7,8,9,0,1,0,1.0,2\n");
}

TEST_F(RunResult, AReportThatWasHandedInTakesPrecedenceOverItsFile) {
  write_all_reports();
  const Json result = merge_result(facts_, scenario_,
                                   read_reports(dir_.path(), scenario_,
                                                {{"station", {{"score", 9.0}, {"unwritten", {"a: full"}}}},
                                                 {"comm_router", {{"unwritten", {"b: full", 7}}}}}));
  EXPECT_EQ(schema_errors(result), std::vector<std::string>{});
  EXPECT_EQ(result["score"], 9.0);
  EXPECT_EQ(result["sim_time_s"], 650.5);
  EXPECT_EQ(result["warnings"].back(), "files are missing or cut short: a: full; b: full");
}

TEST_F(RunResult, SamplesThatWereNotSentAreSummedUpInAWarning) {
  write_all_reports();
  EXPECT_EQ(merged()["radio"]["unsent"], 0);
  EXPECT_EQ(merged()["warnings"].dump().find("could not be sent"), std::string::npos);
  std::map<std::string, Json> handed_in;
  int power = 1;
  for (const char* program : {"sim_server", "station", "comm_router", "uav_agent-alpha", "uav_agent-beta"}) {
    handed_in[program] = {{"unsent", power *= 2}};
  }
  const Json result = merge_result(facts_, scenario_, read_reports(dir_.path(), scenario_, handed_in));
  EXPECT_EQ(schema_errors(result), std::vector<std::string>{});
  EXPECT_EQ(result["radio"]["unsent"], 2 + 4 + 8 + 16 + 32);
  EXPECT_EQ(result["warnings"].back(), "62 samples could not be sent; the logs name topics and reasons");
}

TEST_F(RunResult, ADeepOrWrongReportOfAnAgentIsHarmless) {
  write_all_reports();
  write_text(dir_.path() / "uav_agent-beta.report.json",
             "{\"planner_cpu_s\": " + std::string(200000, '[') + std::string(200000, ']') + "}");
  EXPECT_TRUE(merged()["uavs"][1]["planner_cpu_s"].is_null());
}

}  // namespace
}  // namespace skein::results
