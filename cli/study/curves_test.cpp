#include "cli/study/curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cli/testing/odd_study.hpp"
#include "results/testing/scratch.hpp"

namespace skein::cli {
namespace {

/// Reference implementation: the score at a time is that of the last change at or before it.
double slow_score(const FlightTables& tables, double time_s) {
  double score = 0.0;
  for (const results::ScoreRow& change : tables.scores) {
    if (change.time_s <= time_s) score = change.score;
  }
  return score;
}

TEST(ScoreCurves, AreMedianAndRangeOfTheFlightsAtEveryTime) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 40; ++trial) {
    const Study study = odd_study(random, false);
    const std::vector<double> times_s = curve_times(study);
    ASSERT_TRUE(std::ranges::is_sorted(times_s));
    for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
      for (const ScoreCurve& curve : score_curves(study, s, times_s)) {
        for (std::size_t i = 0; i < times_s.size(); i += 7) {
          std::vector<double> scores;
          for (const FlightEntry* flight : study.cell(curve.planner, s)) {
            if (flight->tables && !flight->tables->scores.empty()) {
              ASSERT_LE(flight->tables->end_s, times_s.back());
              scores.push_back(slow_score(*flight->tables, times_s[i]));
            }
          }
          ASSERT_EQ(scores.size(), curve.flights);
          ASSERT_EQ(curve.least[i], std::ranges::min(scores));
          ASSERT_EQ(curve.greatest[i], std::ranges::max(scores));
          ASSERT_EQ(curve.median[i], spread_of(scores).median);
        }
      }
    }
  }
}

TEST(FlightTables, AreReadAlsoIfSomeAreMissing) {
  const results::Scratch scratch;
  const auto dir = scratch.path();
  EXPECT_TRUE(read_flight_tables(dir).scores.empty()) << "the folder has no tables";
  write_text(dir / "result.json",
             R"({"status": "completed", "sim_time_s": 80, "uavs": [{"name": "a"}, {"name": "b"}]})");
  EXPECT_TRUE(read_flight_tables(dir).latencies.empty()) << "there is no table of captures";
  write_text(dir / "score_timeline.csv", "time_s,points,score\n0,0,0\n10,1,2.5\n20,2,nonsense\n");
  write_text(dir / "captures.csv",
             "uav,capture,tick,time_s,point,q,delivered_at_s,reason\n"
             "a,0,0,1,7,0.5,3,\na,0,0,1,8,0.5,3,\na,1,0,2,9,0.5,,not received\nb,0,0,5,7,0.5,5.5,\n");
  const FlightTables tables = read_flight_tables(dir);
  EXPECT_EQ(tables.end_s, 80.0);
  EXPECT_EQ(tables.score_at(9.99), 0.0);
  EXPECT_EQ(tables.score_at(10.0), 2.5);
  EXPECT_EQ(tables.score_at(79.0), 2.5);
  ASSERT_EQ(tables.latencies.size(), 2u);
  EXPECT_EQ(tables.latencies[0].delays_s, std::vector<double>{2.0})
      << "a capture counts once, however many points it shows";
  EXPECT_EQ(tables.latencies[0].never, 1u);
  EXPECT_EQ(tables.latencies[1].delays_s, std::vector<double>{0.5});
}

}  // namespace
}  // namespace skein::cli
