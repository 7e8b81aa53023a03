#include "cli/bench/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/math/random_stream.hpp"

namespace skein::cli {
namespace {

/// The result of a flight of 1,000 exchanges in one process. The parameters are the costs of its stages in seconds.
Json result(double physics_s, double links_s, double planners_s, double exchange_s) {
  const double cpu_s = physics_s + links_s + planners_s + exchange_s;
  return {{"sim_time_s", 50.0},
          {"timing",
           {{"physics_s", physics_s},
            {"links_s", links_s},
            {"cpu_s", physics_s + links_s},
            {"steps", 1000},
            {"scans", 500}}},
          {"processes", {{"one_process", {{"cpu_s", cpu_s}}}}},
          {"radio", {{"delivered", 3000}}},
          {"uavs", {{{"planner_cpu_s", planners_s}}}}};
}

TEST(BenchProfile, TellsWhatAnExchangeCosts) {
  const Json entry = profile_entry("kios", 10, {result(1, 2, 4, 3), result(2, 2, 6, 3), result(3, 2, 5, 3)});
  EXPECT_EQ(entry["planner"], "kios");
  EXPECT_DOUBLE_EQ(entry["stages"]["physics"]["ms"], 2.0);
  EXPECT_DOUBLE_EQ(entry["stages"]["agents"]["ms"], 5.0);
  EXPECT_DOUBLE_EQ(entry["stages"]["agents"]["us_a_uav"], 500.0);
  EXPECT_DOUBLE_EQ(entry["stages"]["exchange"]["ms"], 3.0);
  EXPECT_DOUBLE_EQ(entry["counts"]["scans"], 0.5);
  EXPECT_DOUBLE_EQ(entry["counts"]["radio"], 3.0);
}

/// Like result(), with the times that the planners of two UAVs report for the parts of their work.
Json result_with_parts(const std::vector<std::pair<std::string, double>>& of_first, double of_second_s) {
  Json flown = result(1, 2, 8, 3);
  Json parts = Json::array();
  for (const auto& [part, cpu_s] : of_first) parts.push_back({{"part", part}, {"cpu_s", cpu_s}});
  flown["uavs"] = {{{"planner_cpu_s", 5.0}, {"planner_parts", parts}},
                   {{"planner_cpu_s", 3.0}, {"planner_parts", {{{"part", "planner/tours"}, {"cpu_s", of_second_s}}}}}};
  return flown;
}

TEST(BenchProfile, SumsThePartsOverTheFleet) {
  const Json entry = profile_entry("kios", 2, {result_with_parts({{"planner/tours", 2.0}, {"maps/other", 1.5}}, 1.0)});
  EXPECT_DOUBLE_EQ(entry["parts"]["planner/tours"]["ms"], 3.0);
  EXPECT_DOUBLE_EQ(entry["parts"]["planner/tours"]["us_a_uav"], 1500.0);
  EXPECT_DOUBLE_EQ(entry["parts"]["maps/other"]["ms"], 1.5);
  double sum_ms = 0.0;
  for (const Json& part : entry["parts"]) sum_ms += part["ms"].get<double>();
  EXPECT_LE(sum_ms, entry["stages"]["agents"]["ms"]);
  EXPECT_TRUE(profile_entry("kios", 10, {result(1, 2, 4, 3)})["parts"].empty())
      << "the agent reports no times of parts";
}

TEST(BenchProfile, PrintsThePartsOfAPlannerAndTheTimeOutsideThem) {
  const std::vector<Json> entries = {
      profile_entry("kios", 2, {result_with_parts({{"planner/tours", 2.0}}, 1.0)}),
      profile_entry("kios", 4, {result_with_parts({{"planner/tours", 4.0}, {"maps/telling", 0.4}}, 2.0)})};
  const Json growth = profile_growth(entries);
  EXPECT_NEAR(growth["parts"]["planner/tours"]["exponent"], 1.0, 1e-9);
  EXPECT_FALSE(growth["parts"].contains("maps/telling")) << "only one fleet size has a time for this part";
  std::ostringstream text;
  print_profile(text, {{"profile", entries}, {"growth", {{"kios", growth}}}});
  for (const char* line : {"\n  maps/telling                      0.0    100.0        -\n",
                           "\n  planner/tours                  1500.0   1500.0   n^1.00\n",
                           "\n  not in any part                2500.0    400.0         \n",
                           "\n  all (agents)                   4000.0   2000.0 "}) {
    EXPECT_NE(text.str().find(line), std::string::npos) << line << text.str();
  }
}

TEST(BenchProfile, APlannerWithOneSizeIsPrintedWithoutItsGrowth) {
  const std::vector<Json> entries = {profile_entry("xxh", 10, {result(1, 2, 4, 3)})};
  std::ostringstream text;
  print_profile(text, {{"profile", entries}, {"growth", {{"xxh", profile_growth(entries)}}}});
  EXPECT_NE(text.str().find("\n  10 "), std::string::npos) << text.str();
  EXPECT_EQ(text.str().find("n^"), std::string::npos) << text.str();
  EXPECT_EQ(text.str().find("by part"), std::string::npos) << text.str();
}

TEST(BenchProfile, FindsTheExponentOfDrawnLaws) {
  RandomStream random(1, "growth", 0);
  for (int i = 0; i < 100; ++i) {
    const double exponent = random.uniform(0.0, 3.0), factor = random.uniform(0.001, 10.0);
    std::vector<std::pair<double, double>> costs = {{7.0, 0.0}};  // growth_of() ignores a cost of 0
    for (const double uavs : {1.0, 2.0, 5.0, 20.0, 100.0}) costs.emplace_back(uavs, factor * std::pow(uavs, exponent));
    const auto growth = growth_of(costs);
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->exponent, exponent, 1e-9);
    EXPECT_NEAR(growth->at(1000.0), factor * std::pow(1000.0, exponent), 1e-6 * growth->at(1000.0));
  }
  EXPECT_FALSE(growth_of({}));
  EXPECT_FALSE(growth_of({{5.0, 1.0}}));
  EXPECT_FALSE(growth_of({{5.0, 1.0}, {5.0, 2.0}})) << "one fleet size shows no growth";
  EXPECT_FALSE(growth_of({{5.0, 0.0}, {9.0, 0.0}}));
}

TEST(BenchProfile, NamesTheStageThatIsTheFirstLimit) {
  std::vector<Json> entries;
  for (const double n : {1.0, 10.0, 100.0}) {  // physics cost most of all here, links most at a thousand
    entries.push_back(profile_entry("patrol", static_cast<std::size_t>(n), {result(n, 1e-3 * n * n, 0.1 * n, n)}));
  }
  const Json growth = profile_growth(entries);
  EXPECT_NEAR(growth["stages"]["physics"]["exponent"], 1.0, 1e-9);
  EXPECT_NEAR(growth["stages"]["line_of_sight"]["exponent"], 2.0, 1e-9);
  EXPECT_NEAR(growth["stages"]["line_of_sight"]["ms_at_1000"], 1000.0, 1e-6);
  EXPECT_FALSE(growth["stages"].contains("camera")) << "no UAV took a picture";
  entries.push_back(profile_entry("patrol", 200, {result(200, 400, 20, 200)}));
  EXPECT_EQ(profile_growth(entries)["first_limit"], "line_of_sight");
  EXPECT_EQ(profile_growth({})["first_limit"], Json());

  std::ostringstream text;
  print_profile(text, {{"profile", entries}, {"growth", {{"patrol", profile_growth(entries)}}}});
  for (const char* word :
       {"patrol", "line_of_sight", "n^1.00", "at 1000", "the first limit: line_of_sight", "each UAV"}) {
    EXPECT_NE(text.str().find(word), std::string::npos) << text.str();
  }
}

}  // namespace
}  // namespace skein::cli
