#include "cli/study/pairs.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <map>
#include <random>
#include <regex>
#include <sstream>

#include "cli/study/csv.hpp"
#include "cli/testing/odd_study.hpp"

namespace skein::cli {
namespace {

TEST(PlannerPairs, AreTheDifferencesOfTheFlights) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 60; ++trial) {
    const Study study = odd_study(random, trial % 2 == 0);
    // The scores of the flights, keyed by planner, scene and seed.
    std::map<std::tuple<std::size_t, std::size_t, std::uint64_t>, double> scores;
    for (const FlightEntry& flight : study.flights) {
      if (flight.figures) scores[{flight.planner, flight.scenario, flight.seed}] = flight.figures->score;
    }
    const auto score = [&](std::size_t planner, std::optional<std::size_t> scenario, std::uint64_t seed) {
      std::optional<double> sum = 0.0;
      for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
        if (scenario && s != *scenario) continue;
        const auto found = scores.find({planner, s, seed});
        sum = sum && found != scores.end() ? std::optional(*sum + found->second) : std::nullopt;
      }
      return sum;
    };
    const std::vector<PlannerPair> pairs = planner_pairs(study);
    const std::size_t n = study.planners.size(), places = study.scenarios.size() + (study.scenarios.size() > 1 ? 1 : 0);
    ASSERT_EQ(pairs.size(), n * (n - 1) / 2 * places);
    for (const PlannerPair& pair : pairs) {
      std::size_t found = 0;
      for (const std::uint64_t seed : study.seeds) {
        const auto a = score(pair.first, pair.scenario, seed), b = score(pair.second, pair.scenario, seed);
        if (!a || !b) continue;
        ASSERT_LT(found, pair.differences.size());
        ASSERT_EQ(pair.differences[found].first, seed);
        ASSERT_NEAR(pair.differences[found++].second, *a - *b, 1e-9);
      }
      ASSERT_EQ(found, pair.differences.size());
      ASSERT_EQ(pair.median.has_value(), found > 0);
      ASSERT_EQ(pair.interval.has_value(), found >= kFewestPairs)
          << "too few pairs have no interval, and all others have one";
      ASSERT_EQ(pair.test.has_value(), found >= kFewestPairs);
      if (pair.interval) {
        ASSERT_LE(pair.interval->low, *pair.median);
        ASSERT_GE(pair.interval->high, *pair.median);
      }
    }
  }
}

/// A study of two planners in one scene, in which the first scores 1 to n more than the second.
Study two_planners(std::uint64_t seeds) {
  Study study{false, Rank::maximum, {"a", "b"}, {"s"}, {}, {}, "", "", "", "", 1};
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    study.seeds.push_back(seed);
    for (const std::size_t planner : {0, 1}) {
      FlightEntry flight{planner, 0, seed, {}, FlightFigures{}, ""};
      flight.figures->score = planner == 0 ? 101.0 + static_cast<double>(seed) : 100.0;
      study.flights.push_back(flight);
    }
  }
  return study;
}

std::string printed_pairs(const Study& study) {
  std::ostringstream out;
  print_pairs(out, study, planner_pairs(study));
  return out.str();
}

TEST(PlannerPairs, TheTerminalShowsWhetherADifferenceIsSignificant) {
  const std::string eight = printed_pairs(two_planners(8));
  EXPECT_TRUE(std::regex_search(eight, std::regex("\n  a - b, s +8 +4\\.5 +[0-9.]+ to [0-9.]+ +0\\.0078 +0\\.0078\n")))
      << eight;
  EXPECT_EQ(eight.find("no difference can be"), std::string::npos) << eight;
  const std::string few = printed_pairs(two_planners(3));
  EXPECT_TRUE(std::regex_search(few, std::regex("\n  a - b, s +3 +2\\.0 +n too small\n"))) << few;
  EXPECT_NE(few.find("with 3 seeds, no difference can be significant"), std::string::npos) << few;
}

TEST(PlannerPairs, AreWrittenAsACsvTable) {
  Study study{false, Rank::maximum, {"a", "b,\"x\""}, {"s", "t"}, {0, 1, 2, 3, 4, 5}, {}, "", "", "", "", 1};
  for (const std::uint64_t seed : study.seeds) {
    for (const std::size_t scenario : {0, 1}) {
      for (const std::size_t planner : {0, 1}) {
        FlightEntry flight{planner, scenario, seed, {}, FlightFigures{}, ""};
        flight.figures->score = planner == 0 ? 0.5 * static_cast<double>(seed) + 1.25 : 0.0;
        if (scenario == 0 || seed < 2) study.flights.push_back(flight);
      }
    }
  }
  const std::vector<PlannerPair> pairs = planner_pairs(study);
  ASSERT_TRUE(pairs.at(0).interval.has_value());
  const auto [low, high] = *pairs[0].interval;
  const std::string head = "figure,scenario,first,second,pairs,median,low,high,p,p_holm\n", two = "a,\"b,\"\"x\"\"\"";
  EXPECT_EQ(pairs_csv(study, pairs), head + fmt::format("score,s,{},6,2.5,{},{},0.03125,0.03125\n", two, low, high) +
                                         fmt::format("score,t,{0},2,1.5,,,,\nscore,,{0},2,3,,,,\n", two));
}

/// Two planners have the same median, and one of them has twice the spread of the other.
TEST(PlannerPairs, CompareOtherFiguresAndTheSpreadOfScores) {
  Study study{false, Rank::maximum, {"a", "b"}, {"s"}, {0, 1, 2, 3, 4, 5, 6}, {}, "", "", "", "", 1};
  for (const std::uint64_t seed : study.seeds) {
    for (const std::size_t planner : {0, 1}) {
      FlightEntry flight{planner, 0, seed, {}, FlightFigures{}, ""};
      const double off = static_cast<double>(seed) - 3.0;
      flight.figures->score = 100.0 + (planner == 0 ? 2.0 : 1.0) * off;
      flight.figures->greatest_share = planner == 0 ? 30.0 : 25.0;
      study.flights.push_back(flight);
    }
  }
  std::map<std::string, PlannerPair> pairs;
  for (const PlannerPair& pair : planner_pairs(study)) pairs.emplace(pair.figure, pair);
  for (const PlannerPair& pair : other_pairs(study)) pairs.emplace(pair.figure, pair);
  EXPECT_NEAR(*pairs.at(kDeviation).median, 2.0, 1e-9);
  EXPECT_NEAR(pairs.at(kDeviation).test->p, 0.03125, 1e-9);
  EXPECT_NEAR(*pairs.at("greatest_share").median, 5.0, 1e-9);
  EXPECT_NEAR(*pairs.at("score").median, 0.0, 1e-9);
  EXPECT_FALSE(pairs.at("mean_quality").median) << "no flight has this figure";
}

TEST(PlannerPairs, ShowPWithFewDigits) {
  EXPECT_EQ(p_text(std::nullopt), "");
  EXPECT_EQ(p_text(0.0004), "< 0.001");
  EXPECT_EQ(p_text(0.0625), "0.0625");
  EXPECT_EQ(p_text(1.0), "1");
}

}  // namespace
}  // namespace skein::cli
