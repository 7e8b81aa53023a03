#include "cli/oracle_command.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

/// A script that replaces sim_server. It writes this answer to the file after --oracle, and its arguments to a file in
/// its own folder.
std::string oracle_script(const std::filesystem::path& dir, const std::string& answer) {
  return "echo \"$*\" > '" + (dir / "arguments").string() +
         "'\nwhile [ \"$1\" != --oracle ]; do shift; done\ncat > \"$2\" <<'END'\n" + answer + "\nEND\n";
}

constexpr const char* kAnswer =
    R"({"points_total": 9, "vehicle": false, "clearance_m": 0.5, "outside_berth_m": 2.5, "directions": 256,
  "reachable": {"points": 8, "score": 7.5, "coarse_points": 8, "coarse_score": 7.25, "change_percent": 3.448},
  "outside": {"points": 5, "score": 4.5, "coarse_points": 5, "coarse_score": 4.5, "change_percent": 0.0}})";

/// The answers in the form in which sim_server writes them: with a number for each point.
std::string rows(std::vector<std::string> answers) {
  Json all = Json::array();
  for (const std::string& text : answers) {
    Json answer = Json::parse(text);
    if (answer.contains("reachable")) {
      answer["estimate"] = {1.0, 0.5};
      answer["flyable"] = "10";
    }
    all.push_back(answer);
  }
  return Json{{"rows", all}}.dump();
}

RunOptions run_of(const std::string& scenario) {
  RunOptions options;
  options.scenario = scenario;
  return options;
}

class OracleCommand : public ::testing::Test {
 protected:
  void answer(const std::string& text) const {
    write_script(programs_.dir() / "sim_server", oracle_script(programs_.dir(), text));
  }
  OracleCommand() { options_.scenario = "mbs"; }
  int run() { return consult_oracle(options_, {out_, err_, false}); }
  std::string arguments() const { return read_text(programs_.dir() / "arguments"); }

  FakePrograms programs_;
  OracleOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(OracleCommand, PrintsReachableAndOutsideOrOnlyOutside) {
  answer(rows({kAnswer}));
  EXPECT_EQ(run(), 0);
  EXPECT_NE(out_.str().find("mbs: 9 interest points, cameras 0.5 m clear"), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("reachable          8         7.5     +3.45 %"), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("outside            5         4.5     +0.00 %"), std::string::npos) << out_.str();
  out_.str("");
  options_.outside_only = true;
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(out_.str().find("reachable"), std::string::npos);
  EXPECT_NE(out_.str().find("less than 5 m wide"), std::string::npos);
}

TEST_F(OracleCommand, ARunIsEstimatedByItsOwnRules) {
  answer(rows({kAnswer}));
  RunOptions flown = run_of("mbs");
  flown.rules = "paper";
  attainable_of(flown);
  EXPECT_NE(arguments().find("--rules paper"), std::string::npos) << arguments();
  options_.rules = "reference";
  EXPECT_EQ(run(), 0);
  EXPECT_NE(arguments().find("--rules reference"), std::string::npos) << arguments();
  options_.rules.reset();
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(arguments().find("--rules"), std::string::npos) << arguments();
}

TEST_F(OracleCommand, PassesItsOptionsToTheServerAndPrintsJson) {
  answer(rows({kAnswer}));
  options_.scene_seed = 4;
  options_.assets = "data";
  options_.clearances_m = {0.75};
  options_.json = true;
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(Json::parse(out_.str()), Json::parse(kAnswer));
  for (const char* words : {"--scenario mbs", "--scene-seed 4", "--assets data", "--clearance 0.75"}) {
    EXPECT_NE(arguments().find(words), std::string::npos) << arguments();
  }
  EXPECT_EQ(arguments().find("--oracle-patience"), std::string::npos);
}

TEST_F(OracleCommand, SeveralClearancesMakeATable) {
  Json second = Json::parse(kAnswer);
  second["clearance_m"] = 1.25;
  second["reachable"]["score"] = 6.25;
  answer(rows({kAnswer, second.dump()}));
  options_.clearances_m = {0.5, 1.25};
  options_.vehicle = true;
  EXPECT_EQ(run(), 0);
  EXPECT_NE(out_.str().find("\n    0.5 m          8         7.5     +3.45 %          5         4.5     +0.00 %\n"
                            "   1.25 m          8         6.2     +3.45 %          5         4.5     +0.00 %\n"),
            std::string::npos)
      << out_.str();
  EXPECT_NE(arguments().find("--clearance 0.5,1.25 --vehicle"), std::string::npos) << arguments();
  out_.str("");
  options_.json = true;
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(Json::parse(out_.str()), (Json{{"rows", {Json::parse(kAnswer), second}}}));
}

/// An answer with a plan. sim_server also adds a plan that is in its cache to an answer.
std::string with_plan() {
  Json answer = Json::parse(kAnswer);
  answer["plan"] = {{"score", 6.0},
                    {"points", 7},
                    {"views", 4},
                    {"margin_m", 0.5},
                    {"flown", {{"score", 6.6}, {"points", 8}, {"collisions", 0}, {"astray_m", 0.25}}},
                    {"uavs", {{{"name", "alpha"}, {"views", 4}, {"time_s", 58.25}, {"distance_m", 77.5}}}}};
  return answer.dump();
}

TEST_F(OracleCommand, ThePlanIsShownOnlyWithItsOption) {
  answer(rows({with_plan()}));
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(out_.str().find("planned"), std::string::npos) << out_.str();
  EXPECT_EQ(arguments().find("--plan"), std::string::npos) << arguments();
  out_.str("");
  options_.plan = true;
  EXPECT_EQ(run(), 0);
  EXPECT_NE(arguments().find(" --plan"), std::string::npos) << arguments();
  for (const char* text : {"a lower bound found by search", "planned       6.0 (80.0 % of reachable), 7 points from 4",
                           "flown         6.6 (88.0 % of reachable), 8 points, collisions: 0, at most 0.25 m off",
                           "  alpha           4 views    58.2 s     77.5 m"}) {
    EXPECT_NE(out_.str().find(text), std::string::npos) << text << '\n' << out_.str();
  }
  out_.str("");
  options_.json = true;
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(Json::parse(out_.str()), Json::parse(with_plan()));
  out_.str("");
  options_.plan = false;
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(Json::parse(out_.str()), Json::parse(kAnswer));
}

TEST_F(OracleCommand, TheAnswerForARunIncludesACachedPlan) {
  answer(rows({with_plan()}));
  EXPECT_EQ(attainable_of(run_of("mbs")).attainable["plan"],
            Json::parse(R"({"points": 7, "score": 6.0, "flown_score": 6.6})"));
  EXPECT_EQ(arguments().find("--plan"), std::string::npos) << arguments();
}

TEST_F(OracleCommand, FailuresAreReported) {
  write_script(programs_.dir() / "sim_server", "echo 'no such scenario' >&2; exit 2");
  EXPECT_THROW(run(), InputError);
  write_script(programs_.dir() / "sim_server", "exit 3");
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_NE(attainable_of({}).hint.find("failed"), std::string::npos);
  answer("half a {");
  EXPECT_THROW(run(), std::runtime_error);
}

TEST_F(OracleCommand, ARunGetsTheEstimateOrAHint) {
  answer(rows({kAnswer}));
  const AttainableAnswer known = attainable_of(run_of("mbs"));
  EXPECT_EQ(known.attainable, Json::parse(R"({"points": 8, "score": 7.5, "clearance_m": 0.5,
                                              "outside": {"points": 5, "score": 4.5}})"));
  EXPECT_TRUE(known.hint.empty());
  EXPECT_EQ(known.by_point["flyable"], "10");
  EXPECT_NE(arguments().find("--oracle-patience"), std::string::npos);

  answer(rows({R"({"expected_s": 99.0})"}));
  const AttainableAnswer unknown = attainable_of(run_of("big.yaml"));
  EXPECT_TRUE(unknown.attainable.is_null());
  EXPECT_NE(unknown.hint.find("skein oracle big.yaml"), std::string::npos) << unknown.hint;

  RunOptions run = run_of("big.yaml");
  run.scene_seed = 7;
  run.assets = "my data";
  run.rules = "paper";
  const std::string hint = attainable_of(run).hint;
  EXPECT_NE(hint.find("`skein oracle big.yaml --scene-seed 7 --assets 'my data' --rules paper`"), std::string::npos)
      << hint;
}

}  // namespace
}  // namespace skein::cli
