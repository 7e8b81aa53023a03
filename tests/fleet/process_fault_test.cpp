// Programs that a fault file kills or pauses and lets back in: such runs are as deterministic as any other.
#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

/// Long enough that photographers work before, during and after the absence of programs.
const Arguments kFaultedTowers = {"towers", "--planner", "patrol", "--duration", "75"};

class ProcessFaults : public FleetTest {
 protected:
  /// @param faults  lines of the file's list.
  SkeinRun& fly(const std::string& name, const std::string& faults, const Arguments& more,
                const Environment& environment = {}) {
    Arguments arguments = kFaultedTowers;
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), {"--faults", write(name + ".yaml", "faults:\n" + faults)});
    return run(name, arguments, environment);
  }

  /// Two runs with the same faults, and otherwise as different as possible.
  std::pair<Json, Json> fly_twice(const std::string& faults) {
    const std::string one = "one" + std::to_string(pairs_), two = "two" + std::to_string(pairs_);
    ++pairs_;
    const Json first = fly(one, faults, {"--one-process"}).result();
    const Json second = fly(two, faults, {"--dds", "mixed"}, {{"SKEIN_CHAOS", "1"}}).result();
    for (const Json& result : {first, second}) {
      EXPECT_EQ(result["status"], "completed");
      EXPECT_TRUE(result["deterministic"]);
      EXPECT_TRUE(result["lost_members"].empty())
          << "a program that a fault takes out counts as lost: " << result["lost_members"];
      EXPECT_TRUE(result["warnings"].empty()) << result["warnings"];
      EXPECT_GT(result["score"], 50.0);
    }
    for (const char* key : {"digest", "score", "score_earned", "score_by_uav", "points_detected", "radio", "faults"}) {
      EXPECT_EQ(first[key], second[key]) << key;
    }
    EXPECT_EQ(text_of(folder() / one / "captures.csv"), text_of(folder() / two / "captures.csv"));
    EXPECT_EQ(text_of(folder() / one / "score_timeline.csv"), text_of(folder() / two / "score_timeline.csv"));
    return {first, second};
  }

 private:
  int pairs_ = 0;
};

constexpr const char* kAway =
    "  - {at_s: 20.0, until_s: 23.0, ORDER: jurong}\n"
    "  - {at_s: 30.0, until_s: 35.0, ORDER: comm_router}\n"
    "  - {at_s: 38.0, until_s: 42.0, ORDER: station}\n"
    "  - {at_s: 40.0, until_s: 45.0, ORDER: sentosa}\n"
    "  - {at_s: 44.0, until_s: 45.0, ORDER: comm_router}\n";  // two programs come back at the same time

std::string all_away(const std::string& order) {
  std::string text = kAway;
  for (std::size_t at; (at = text.find("ORDER")) != std::string::npos;) text.replace(at, 5, order);
  return text;
}

TEST_F(ProcessFaults, AProgramThatIsKilledComesBack) {
  const auto [result, other] = fly_twice(all_away("kill"));
  EXPECT_EQ(result["score"], result["score_earned"]) << "all is delivered in the end";
  const std::string log = text_of(folder() / "one0" / "station.log");
  EXPECT_NE(log.find("a fault kills this program"), std::string::npos) << log;
  EXPECT_NE(log.find("here it starts again"), std::string::npos) << log;
  EXPECT_NE(log.find("records of the journal"), std::string::npos) << log;
}

TEST_F(ProcessFaults, AProgramThatIsStoppedContinues) {
  const auto [result, other] = fly_twice(all_away("pause"));
  EXPECT_EQ(result["score"], result["score_earned"]) << "all is delivered in the end";
  EXPECT_NE(text_of(folder() / "one0" / "uav_agent-sentosa.log").find("a fault stops this program"), std::string::npos);
}

TEST_F(ProcessFaults, AProgramThatNeverComesBackLeavesItsFiles) {
  const auto [result, other] = fly_twice(
      "  - {at_s: 50.0, kill: station}\n"
      "  - {at_s: 45.0, pause: sentosa}\n"
      "  - {at_s: 55.0, kill: comm_router}\n");
  EXPECT_LT(result["score"], result["score_earned"]);
  EXPECT_GT(result["radio"]["delivered"], 0);
  double score = 0.0;
  for (const auto& row : read_csv(folder() / "one0" / "score.csv")) score += std::stod(row.at("score"));
  EXPECT_NEAR(score, result["score"].get<double>(), 1e-3);
  for (const Json& uav : result["uavs"]) EXPECT_EQ(uav["planner_cpu_s"].is_null(), uav["name"] == "sentosa");
}

TEST_F(ProcessFaults, AUsersCommandThatDoesNotComeBackAfterAFaultIsLost) {
  const std::string command = "test ! -e " + (folder() / "second").string() + " && touch " +
                              (folder() / "second").string() + " && exec " + helper_program("minimal_client");
  const auto faults = write("command.yaml", "faults: [{at_s: 4.0, until_s: 6.0, kill: sentosa}]\n");
  SkeinRun& run = this->run(
      "command", {"towers", "--planner", "hover,sentosa=exec:" + command, "--duration", "20", "--faults", faults}, {},
      3);
  EXPECT_NE(run.err().find("uav_agent-sentosa failed: exit code 1"), std::string::npos) << run.err();
  expect_complete_result(run);
  const Json result = run.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_NEAR(result["mission_time_s"].get<double>(), 20.0, 0.1) << "the other UAVs did not fly on";
  ASSERT_EQ(result["lost_members"].size(), 1U);
  EXPECT_EQ(result["lost_members"][0]["member"], "sentosa");
}

}  // namespace
}  // namespace skein::test
