#include "cli/study/conditions_table.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace skein::cli {
namespace {

std::string printed(const Study& study) {
  std::ostringstream out;
  print_conditions(out, study);
  return out.str();
}

TEST(ConditionsTable, ComparesMediansWithThoseOfTheFirstConditionsAndCountsFalls) {
  Study study;
  study.planners = {"kios", "star"};
  const auto add = [&](const std::string& conditions, std::size_t planner, double percent, int collisions, int falls) {
    FlightEntry entry{planner, study.scenarios.size(), 0, {}, FlightFigures(), ""};
    entry.figures->attainable_percent = percent;
    entry.figures->collisions = collisions;
    entry.figures->collisions_by_battery = falls;
    entry.figures->attainable = 200.0;
    if (planner == 0) entry.figures->losses = {{"never_in_picture", 200.0 - 2.0 * percent - falls}, {"energy", falls}};
    study.scenarios.push_back("wild " + conditions);
    study.scene_conditions.push_back(conditions);
    study.flights.push_back(std::move(entry));
  };
  for (const double percent : {40.0, 50.0, 80.0}) add("none", 0, percent, 0, 0);
  for (const double percent : {20.0, 30.0, 35.0}) add("harsh", 0, percent, 2, 1);
  add("none", 1, 0.0, 0, 0);
  add("harsh", 1, 10.0, 1, 0);
  study.flights.push_back({1, 7, 1, {}, std::nullopt, "failed"});
  const std::string text = printed(study);
  EXPECT_NE(text.find("| `none` | `kios` | 3 | 50.0 | 100 | 0 | 0 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| `harsh` | `kios` | 3 | 30.0 | 60 | 6 | 3 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| `harsh` | `star` | 1 | 10.0 | - | 1 | 0 |"), std::string::npos) << text;
  // Of 600 attainable points, 430 are lost, 3 of them to batteries.
  EXPECT_NE(text.find("| `harsh` | `kios` | - | 71.2 | - | - | - | - | - | - | - | - | 0.5 | - |"), std::string::npos)
      << text;
  EXPECT_NE(text.find("| `harsh` | `star` | - | - |"), std::string::npos) << text;
}

TEST(ConditionsTable, SplitsTheScoreOfPicturesThatAreTooPoorToCount) {
  Study study;
  study.planners = {"kios"};
  study.scene_conditions = {"none"};
  study.scenarios = {"towers none"};
  const auto add = [&](double score, std::map<std::string, double> parts) {
    FlightEntry entry{0, 0, study.flights.size(), {}, FlightFigures(), ""};
    entry.figures->attainable = 100.0;
    entry.figures->losses = {{"below_threshold", score}};
    entry.figures->poor_parts = std::move(parts);
    study.flights.push_back(std::move(entry));
  };
  add(30.0, {{"distance", 0.0}, {"tilt", 10.0}, {"blur", 20.0}, {"unsplit", 0.0}});
  add(8.0, {});  // an earlier version kept no parts
  const std::string text = printed(study);
  EXPECT_NE(
      text.find("| too poor to count: from too far away | too poor to count: too much from the side | too poor to "
                "count: blurred | too poor to count: part not known |\n"),
      std::string::npos)
      << text;
  EXPECT_NE(
      text.find("| `none` | `kios` | - | - | 19.0 | - | - | - | - | - | - | - | - | - | 0.0 | 5.0 | 10.0 | 4.0 |\n"),
      std::string::npos)
      << text;
}

TEST(ConditionsTable, IsEmptyWithoutConditions) {
  Study study;
  study.planners = {"kios"};
  study.scenarios = {"towers"};
  EXPECT_EQ(printed(study), "");
}

}  // namespace
}  // namespace skein::cli
