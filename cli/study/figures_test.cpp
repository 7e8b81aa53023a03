#include "cli/study/figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "cli/study/csv.hpp"
#include "cli/testing/odd_study.hpp"

namespace skein::cli {
namespace {

Json a_result() {
  return Json::parse(R"({"score": 600, "points_detected": 800, "points_total": 2000, "status": "completed",
    "digest": "ab", "attainable": {"points": 1500, "score": 1200}, "collisions": [{}, {}], "real_time_factor": 12.5,
    "sim_time_s": 200, "mission_time_s": 190,
    "flight_check": {"braking_hits": 3, "braking_meets": 0, "ways_meet": 4, "least_clearance_m": -0.25,
                     "least_separation_m": 1.5}, "uavs": [
      {"role": "explorer", "idle_s": 10, "distance_m": 100, "planner_cpu_s": 4},
      {"role": "photographer", "idle_s": 20, "distance_m": 200, "planner_cpu_s": 8},
      {"role": "photographer", "idle_s": 50, "distance_m": null, "planner_cpu_s": null}]})");
}

TEST(StudyFigures, AreReadFromAResult) {
  const FlightFigures figures = figures_of(a_result());
  EXPECT_EQ(figures.score, 600.0);
  EXPECT_EQ(figures.attainable_percent, 50.0);
  EXPECT_EQ(figures.mean_quality, 0.75);
  EXPECT_EQ(figures.collisions, 2);
  EXPECT_EQ(figures.idle_explorers_s, 10.0);
  EXPECT_EQ(figures.idle_photographers_s, 35.0);
  EXPECT_EQ(figures.distance_m, 300.0);
  EXPECT_NEAR(*figures.planner_cpu_ms, 30.0, 1e-9) << "each UAV's planner needs 6 s in 200 s";
  EXPECT_EQ(figures.braking_hits, 3.0);
  EXPECT_EQ(figures.braking_meets, 0.0);
  EXPECT_EQ(figures.ways_meet, 4.0);
  EXPECT_EQ(figures.least_clearance_m, -0.25);
  EXPECT_EQ(figures.least_separation_m, 1.5);
}

TEST(StudyFigures, WorkAndWaitingAreSummedUp) {
  Json result = a_result();
  for (const auto& [uav, frozen_s, excused_s, longest_s] :
       {std::tuple(0, 0.0, 5.0, 40.0), std::tuple(1, 70.0, 45.0, 70.0), std::tuple(2, 130.0, 0.0, 65.0)}) {
    result["uavs"][uav].update({{"frozen_s", frozen_s}, {"excused_s", excused_s}, {"without_work_s", longest_s}});
  }
  result["uavs"][0]["waited_s"] = 12.5;
  result["uavs"][1]["waited_s"] = nullptr;
  const FlightFigures figures = figures_of(result);
  EXPECT_EQ(figures.frozen_uavs, 2) << "time spent waiting is not subtracted from frozen time";
  EXPECT_EQ(figures.frozen_s, 200.0);
  EXPECT_EQ(figures.waiting_uavs, 2);
  EXPECT_EQ(figures.waited_s, 12.5);
  EXPECT_EQ(figures.without_work_s, 70.0);
  EXPECT_FALSE(figures_of(a_result()).frozen_s);
}

/// Some flights failed, some are missing, some are there twice, and their order is random.
TEST(StudyFigures, OfIndexedFlightsEqualThoseOfASearchOverAllFlights) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 100; ++trial) {
    Study study = odd_study(random, false);
    std::vector<FlightEntry> drawn;
    for (const FlightEntry& flight : study.flights) {
      for (std::size_t times = random() % 8 == 0 ? random() % 3 : 1; times > 0; --times) drawn.push_back(flight);
    }
    std::ranges::shuffle(drawn, random);
    study.flights = {};
    for (const FlightEntry& flight : drawn) study.flights.push_back(flight);
    ASSERT_EQ(study.flights.size(), drawn.size());
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
        std::vector<const FlightEntry*> cell;
        for (const FlightEntry& flight : study.flights) {
          if (flight.planner == p && flight.scenario == s && flight.figures) cell.push_back(&flight);
        }
        ASSERT_EQ(study.cell(p, s), cell);
        const auto best = std::ranges::max_element(cell, {}, [](const auto* flight) { return flight->figures->score; });
        ASSERT_EQ(study.best(p, s), best == cell.end() ? nullptr : *best);
      }
      for (const std::uint64_t seed : study.seeds) {
        double sum = 0.0;
        std::size_t count = 0;
        for (const FlightEntry& flight : drawn) {
          if (flight.planner != p || flight.seed != seed || !flight.figures) continue;
          sum += flight.figures->score;
          ++count;
        }
        const auto total = total_of(study, p, seed, [](const FlightEntry& flight) { return flight.figures->score; });
        ASSERT_EQ(total.has_value(), count == study.scenarios.size());
        if (total) {
          ASSERT_EQ(*total, sum);
        }
      }
    }
    ASSERT_TRUE(study.cell(study.planners.size(), 0).empty());
  }
}

TEST(StudyFigures, AFigureThatWasNotReportedHasNoValue) {
  const FlightFigures figures =
      figures_of(Json::parse(R"({"score": 0, "attainable": {"points": null, "score": null}})"));
  EXPECT_FALSE(figures.attainable_percent || figures.mean_quality || figures.idle_explorers_s ||
               figures.idle_photographers_s || figures.planner_cpu_ms || figures.braking_hits ||
               figures.least_clearance_m);
  EXPECT_NO_THROW(figures_of(Json()));
}

/// Reference implementation: the value at place (n - 1) * share of the sorted sample, linear between two values.
double slow_quantile(std::vector<double> values, int quarter) {
  std::sort(values.begin(), values.end());
  std::vector<double> fine;  // the sample, with four steps between neighbours
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    for (int k = 0; k < 4; ++k) fine.push_back(values[i] + (values[i + 1] - values[i]) * k / 4.0);
  }
  fine.push_back(values.back());
  return fine[(values.size() - 1) * static_cast<std::size_t>(quarter)];
}

TEST(StudyFigures, QuartilesAgreeWithTheirDefinition) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 5000; ++trial) {
    std::vector<double> values(1 + random() % 12);
    for (double& value : values) value = static_cast<double>(random() % 1000);
    const Spread spread = spread_of(values);
    ASSERT_EQ(spread.count, values.size());
    ASSERT_EQ(spread.min, *std::min_element(values.begin(), values.end()));
    ASSERT_EQ(spread.max, *std::max_element(values.begin(), values.end()));
    ASSERT_NEAR(spread.q1, slow_quantile(values, 1), 1e-9);
    ASSERT_NEAR(spread.median, slow_quantile(values, 2), 1e-9);
    ASSERT_NEAR(spread.q3, slow_quantile(values, 3), 1e-9);
  }
  EXPECT_EQ(spread_of({}).count, 0u);
}

FlightEntry flight(std::size_t planner, std::size_t scenario, std::uint64_t seed, double score) {
  FlightEntry entry{planner, scenario, seed, {}, FlightFigures{}, ""};
  entry.figures->score = score;
  return entry;
}

/// Two scenes and three tests. The totals of planner a are 10, 20, 90, those of b 40, 40, 40; c did not finish a test.
Study three_planners() {
  Study study{true, Rank::maximum, {"a", "b", "c,\"x\""}, {"s", "t"}, {1, 2, 3}, {}, "", "", "", "", 1};
  for (const std::uint64_t seed : study.seeds) {
    const double a = seed == 3 ? 45.0 : 5.0 * static_cast<double>(seed);
    for (const std::size_t scenario : {0, 1}) {
      study.flights.push_back(flight(0, scenario, seed, a));
      study.flights.push_back(flight(1, scenario, seed, 20.0));
      study.flights.push_back(flight(2, scenario, seed, 500.0));
      if (scenario == 1) study.flights.back() = {2, 1, seed, {}, std::nullopt, "crashed, \"badly\""};
    }
  }
  return study;
}

std::string order(const Study& study) {
  std::string text;
  for (const Standing& standing : standings(study)) text += study.planners[standing.planner].substr(0, 1);
  return text;
}

TEST(StudyFigures, RanksByMaximumMedianOrWorst) {
  Study study = three_planners();
  EXPECT_EQ(order(study), "abc");
  const Standing first = standings(study).front();
  EXPECT_EQ(first.totals, (std::vector<std::optional<double>>{10.0, 20.0, 90.0}));
  EXPECT_EQ(first.decides, 90.0);
  study.rank = Rank::median;
  EXPECT_EQ(order(study), "bac");
  study.rank = Rank::worst;
  EXPECT_EQ(order(study), "bac");
  EXPECT_FALSE(standings(study).back().decides) << "a planner without a complete test is not ranked";
}

TEST(StudyFigures, PlannersWithEqualTotalsShareAPlace) {
  Study study{true, Rank::maximum, {"a", "b", "c"}, {"s"}, {1}, {}, "", "", "", "", 1};
  study.flights = {flight(0, 0, 1, 5.0), flight(1, 0, 1, 7.0), flight(2, 0, 1, 7.0)};
  const auto all = standings(study);
  EXPECT_EQ(order(study), "bca");
  EXPECT_EQ(all[0].place, 1);
  EXPECT_EQ(all[1].place, 1);
  EXPECT_EQ(all[2].place, 3);
}

TEST(StudyFigures, TheBestFlightIsTheOneWithTheHighestScore) {
  const Study study = three_planners();
  EXPECT_EQ(study.best(0, 0)->seed, 3u);
  EXPECT_EQ(study.best(1, 0)->seed, 1u) << "the first of the flights with the same score";
  EXPECT_EQ(study.best(2, 1), nullptr);
}

std::size_t cells(const std::string& line) {
  std::size_t count = 1;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) ++count;
  }
  return count;
}

TEST(StudyFigures, EveryLineOfACsvFileHasAllColumns) {
  const Study study = three_planners();
  const std::vector<std::pair<std::string, std::size_t>> files = {{flights_csv(study), 18},
                                                                  {summary_csv(study), 6},
                                                                  {totals_csv(study), 3},
                                                                  {pairs_csv(study, planner_pairs(study)), 9}};
  for (const auto& [csv, lines] : files) {
    std::istringstream in(csv);
    std::string line;
    std::getline(in, line);
    const std::size_t columns = cells(line);
    std::size_t count = 0;
    for (; std::getline(in, line); ++count) EXPECT_EQ(cells(line), columns) << line;
    EXPECT_EQ(count, lines);
  }
  EXPECT_NE(flights_csv(study).find("\"c,\"\"x\"\"\""), std::string::npos);
  EXPECT_NE(totals_csv(study).find("\n1,a,max,10,20,90,90,20,10\n"), std::string::npos) << totals_csv(study);
  EXPECT_TRUE(totals_csv(study).ends_with("\n,\"c,\"\"x\"\"\",max,,,,,,\n")) << "no complete test, no place";
}

}  // namespace
}  // namespace skein::cli
