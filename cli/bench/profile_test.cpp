#include "cli/bench/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/random_stream.hpp"

namespace skein::cli {
namespace {

/// A flight of 1,000 exchanges in one process whose stages cost so much, in seconds.
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

TEST(BenchProfile, FindsTheExponentOfDrawnLaws) {
  RandomStream random(1, "growth", 0);
  for (int i = 0; i < 100; ++i) {
    const double exponent = random.uniform(0.0, 3.0), factor = random.uniform(0.001, 10.0);
    std::vector<std::pair<double, double>> costs = {{7.0, 0.0}};  // what cost nothing says nothing
    for (const double uavs : {1.0, 2.0, 5.0, 20.0, 100.0}) costs.emplace_back(uavs, factor * std::pow(uavs, exponent));
    const auto growth = growth_of(costs);
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->exponent, exponent, 1e-9);
    EXPECT_NEAR(growth->at(1000.0), factor * std::pow(1000.0, exponent), 1e-6 * growth->at(1000.0));
  }
  EXPECT_FALSE(growth_of({}));
  EXPECT_FALSE(growth_of({{5.0, 1.0}}));
  EXPECT_FALSE(growth_of({{5.0, 1.0}, {5.0, 2.0}})) << "one size";
  EXPECT_FALSE(growth_of({{5.0, 0.0}, {9.0, 0.0}}));
}

TEST(BenchProfile, NamesWhatIsTheFirstLimit) {
  std::vector<Json> entries;
  for (const double n : {1.0, 10.0, 100.0}) {  // physics cost most of all here, links most at a thousand
    entries.push_back(profile_entry("patrol", static_cast<std::size_t>(n), {result(n, 1e-3 * n * n, 0.1 * n, n)}));
  }
  const Json growth = profile_growth(entries);
  EXPECT_NEAR(growth["stages"]["physics"]["exponent"], 1.0, 1e-9);
  EXPECT_NEAR(growth["stages"]["line_of_sight"]["exponent"], 2.0, 1e-9);
  EXPECT_NEAR(growth["stages"]["line_of_sight"]["ms_at_1000"], 1000.0, 1e-6);
  EXPECT_FALSE(growth["stages"].contains("camera")) << "nothing was taken";
  entries.push_back(profile_entry("patrol", 200, {result(200, 400, 20, 200)}));
  EXPECT_EQ(profile_growth(entries)["first_limit"], "line_of_sight");
  EXPECT_EQ(profile_growth({})["first_limit"], Json());

  std::ostringstream text;
  print_profile(text, {{"profile", entries}, {"growth", {{"patrol", profile_growth(entries)}}}});
  for (const char* word : {"patrol", "line_of_sight", "n^1.00", "1000"}) {
    EXPECT_NE(text.str().find(word), std::string::npos) << text.str();
  }
}

}  // namespace
}  // namespace skein::cli
