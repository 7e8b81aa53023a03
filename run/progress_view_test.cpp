#include "run/progress_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "host/preflight.hpp"

namespace skein::cli {
namespace {

status::Progress progress(double t, double mission_s, Phase phase = Phase::flying) {
  return {.time_s = t,
          .mission_s = mission_s,
          .duration_s = 100,
          .phase = phase,
          .in_contact = {"alpha"},
          .alive = 2,
          .lost = {}};
}

TEST(ProgressView, PlainOutputHasALineEveryTenthOfTheMission) {
  std::ostringstream out;
  ProgressView view(out, false);
  for (int i = 0; i <= 1000; ++i) view.progress(progress(2.0 + 0.1 * i, 0.1 * i), 0.01 * i);
  view.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(ProgressView, TheLineShowsTimeSpeedScoreAndContact) {
  std::ostringstream out;
  ProgressView view(out, false);
  view.tally({.points = 12, .score = 3.5, .earned = 4.0});
  view.progress(progress(0.0, 0.0), 1.0);
  view.progress(progress(40.0, 38.0), 3.0);
  EXPECT_EQ(out.str(), "simulated 40.0 s, mission 38 of 100 s, x20.0, points 12, score 3.5, in contact: alpha\n");
}

TEST(ProgressView, TheLineOfATerminalIsRewrittenAndMessagesAppearAboveIt) {
  std::ostringstream out;
  ProgressView view(out, true);
  view.waiting_for({.members = {"alpha", "station"}, .missing = {}, .what = "to join", .seconds = 2.4, .due = false});
  view.progress(progress(0.5, 0.0, Phase::waiting), 0.1);
  view.message("hello");
  view.finish();
  EXPECT_EQ(
      out.str(),
      "\rwaiting for alpha, station to join (2 s)\rsimulated 0.5 s, before take-off, x0.0, points 0, score 0.0, in "
      "contact: alpha\nhello\n");
}

TEST(ProgressView, WithoutATerminalAWaitIsPrintedWhenItIsDue) {
  std::ostringstream out;
  ProgressView view(out, false);
  for (const double seconds : {4.5, 5.0, 5.5}) {
    view.waiting_for(
        {.members = {"bob"}, .missing = {}, .what = "to answer", .seconds = seconds, .due = seconds == 5.0});
  }
  EXPECT_EQ(out.str(), "waiting for bob to answer (5 s)\n");
}

TEST(ProgressView, AnEmptyStatusIsHarmless) {
  std::ostringstream out;
  ProgressView view(out, true);
  view.progress({}, 0.0);
  view.waiting_for({});
  view.tally({});
  view.finish();
}

TEST(Summary, NamesThePageThatExplainsTheScoreIfThereIsOne) {
  const ScratchDir folder;
  const Json result = {{"status", "completed"},
                       {"collisions", Json::array()},
                       {"digest", nullptr},
                       {"uavs", Json::array()},
                       {"warnings", Json::array()}};
  const auto told = [&] {
    std::ostringstream out;
    print_summary(out, result, folder.path());
    return out.str();
  };
  EXPECT_TRUE(told().ends_with("results   " + folder.path().string() + "\n")) << told();
  std::ofstream(folder.path() / "report.html") << "<html/>";
  EXPECT_TRUE(told().ends_with("report    " + (folder.path() / "report.html").string() + "\n")) << told();
}

TEST(Summary, ShowsTheShareOfTheAttainableScore) {
  Json result = {{"score", 30.0},
                 {"score_earned", 40.0},
                 {"points_detected", 31},
                 {"points_total", 99},
                 {"attainable", {{"points", 80}, {"score", 75.0}}},
                 {"status", "completed"},
                 {"collisions", Json::array()},
                 {"digest", nullptr},
                 {"uavs", Json::array()},
                 {"warnings", Json::array()}};
  std::ostringstream known, unknown;
  print_summary(known, result, "there");
  EXPECT_NE(known.str().find("30.000 of 40.000 earned (75.0 % delivered), 40.0 % of attainable\n"), std::string::npos);
  EXPECT_NE(known.str().find("31 of 99, 80 attainable\n"), std::string::npos) << known.str();
  EXPECT_EQ(known.str().find("lost"), std::string::npos);
  result["losses"] = {{"out_of_reach", {{"points", 0}, {"score", 0.0}}},
                      {"blur", {{"points", 12}, {"score", 3.25}}},
                      {"above_estimate", {{"points", 1}, {"score", -0.125}}}};
  known.str("");
  print_summary(known, result, "there");
  EXPECT_NE(known.str().find("lost      blurred                      3.250      12 points\n"
                             "          above the estimate          -0.125       1 points\n"
                             "status"),
            std::string::npos)
      << known.str();
  result["losses"] = {{"below_threshold",
                       {{"points", 5},
                        {"score", 3.5},
                        {"by_part",
                         {{"tilt", {{"points", 4}, {"score", 3.25}}},
                          {"blur", {{"points", 0}, {"score", 0.0}}},
                          {"unsplit", {{"points", 1}, {"score", 0.25}}}}}}},
                      {"voided", {{"points", 2}, {"score", 1.5}}}};
  known.str("");
  print_summary(known, result, "there");
  EXPECT_NE(known.str().find("lost      too poor to count            3.500       5 points\n"
                             "            too much from the side     3.250       4 points\n"
                             "            part not known             0.250       1 points\n"
                             "          UAV collided                 1.500       2 points\n"),
            std::string::npos)
      << known.str();
  result["losses"] = nullptr;
  result["attainable"] = {{"points", nullptr}, {"score", nullptr}};
  print_summary(unknown, result, "there");
  EXPECT_EQ(unknown.str().find("attainable"), std::string::npos) << unknown.str();
}

TEST(ProgressView, AUavWhoseProgramIsLostIsNotInContact) {
  std::ostringstream out;
  ProgressView view(out, false);
  status::Progress status = progress(40.0, 38.0);
  status.in_contact = {"alpha", "beta"};
  status.lost = {"alpha"};
  view.progress(status, 3.0);
  EXPECT_NE(out.str().find("in contact: beta, lost: alpha\n"), std::string::npos) << out.str();
}

TEST(Summary, ALongPlannerIsCutBetweenTwoLetters) {
  const std::string letters(26, 'a');
  const Json result = {{"status", "completed"},
                       {"collisions", Json::array()},
                       {"digest", nullptr},
                       {"uavs", Json::parse(R"([{"name": "ada", "role": "explorer"}])")},
                       {"planner", {{"ada", "py:" + letters + "\u00e9\u00e9.py"}}},
                       {"score_by_uav", Json::object()},
                       {"warnings", Json::array()}};
  std::ostringstream out;
  print_summary(out, result, "there");
  EXPECT_NE(out.str().find(" py:" + letters + ".. "), std::string::npos) << out.str();
}

TEST(ProgressView, TheTableShowsThatAProgramIsLost) {
  const Json uavs = Json::parse(R"([{"name": "ada", "role": "explorer", "alive": true, "program_lost": true},
                                    {"name": "bob", "role": "explorer", "alive": true, "program_lost": false},
                                    {"name": "cy", "role": "explorer", "alive": false, "program_lost": true}])");
  const Json result = {{"status", "completed"},
                       {"collisions", Json::array()},
                       {"digest", nullptr},
                       {"uavs", uavs},
                       {"planner", {{"ada", "hover"}, {"bob", "hover"}, {"cy", "hover"}}},
                       {"score_by_uav", Json::object()},
                       {"warnings", Json::array()}};
  std::ostringstream out;
  print_summary(out, result, "there");
  EXPECT_TRUE(std::regex_search(out.str(), std::regex("\nada +explorer +hover +lost "))) << out.str();
  EXPECT_TRUE(std::regex_search(out.str(), std::regex("\nbob +explorer +hover +alive "))) << out.str();
  EXPECT_TRUE(std::regex_search(out.str(), std::regex("\ncy +explorer +hover +collided "))) << out.str();
}

TEST(ProgressView, TheTableShowsWholeNamesOfPlanners) {
  const Json result = {{"status", "completed"},
                       {"collisions", Json::array()},
                       {"digest", nullptr},
                       {"uavs", Json::parse(R"([{"name": "ada", "role": "explorer", "alive": true},
                                                {"name": "bob", "role": "photographer", "alive": true}])")},
                       {"planner", {{"ada", "py:my_planner.py:height_m=9"}, {"bob", std::string(50, 'x')}}},
                       {"score_by_uav", Json::object()},
                       {"warnings", Json::array()}};
  std::ostringstream out;
  print_summary(out, result, "there");
  EXPECT_NE(out.str().find(" py:my_planner.py:height_m=9 "), std::string::npos) << out.str();
  EXPECT_NE(out.str().find(" " + std::string(30, 'x') + ".. "), std::string::npos) << out.str();
}

}  // namespace
}  // namespace skein::cli
