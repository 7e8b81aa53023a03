#include "cli/study/pairs.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "cli/testing/odd_study.hpp"

namespace skein::cli {
namespace {

TEST(PlannerPairs, AreTheDifferencesOfTheFlights) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 60; ++trial) {
    const Study study = odd_study(random, trial % 2 == 0);
    // By planner, scene and seed, straight from the flights.
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
      ASSERT_EQ(pair.interval.has_value(), found >= kFewestPairs) << "n too small";
      ASSERT_EQ(pair.test.has_value(), found >= kFewestPairs);
      if (pair.interval) {
        ASSERT_LE(pair.interval->low, *pair.median);
        ASSERT_GE(pair.interval->high, *pair.median);
      }
    }
  }
}

TEST(PlannerPairs, SayHowLikelyInFewDigits) {
  EXPECT_EQ(p_text(std::nullopt), "");
  EXPECT_EQ(p_text(SignedRank{9, 0.0004, true}), "< 0.001");
  EXPECT_EQ(p_text(SignedRank{5, 0.0625, true}), "0.0625");
  EXPECT_EQ(p_text(SignedRank{5, 1.0, true}), "1");
}

}  // namespace
}  // namespace skein::cli
