// The score against a brute-force count over all captures, in any order.
#include "core/scoring/score_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/math/random_stream.hpp"

namespace skein {
namespace {

constexpr std::size_t kUavs = 5, kPoints = 40;

/// A random mission: few distinct scores and ticks, so that ties are common.
struct Mission {
  std::vector<CaptureReport> captures;
  std::vector<std::size_t> collided;
};

Mission random_mission(std::uint64_t key) {
  RandomStream random(key, "score_table_test", 0, 0);
  const auto below = [&random](std::size_t n) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
  };
  Mission mission;
  std::vector<std::uint64_t> number(kUavs, 0);
  Tick tick = 0;
  for (int i = 0; i < 120; ++i) {
    tick += static_cast<Tick>(41 * below(2));
    CaptureReport report;
    report.uav = UavIndex(below(kUavs));
    report.capture = number[report.uav]++;
    report.tick = tick;
    for (std::uint32_t point = 0; point < kPoints; ++point) {
      if (below(6) == 0) {
        const float q = 0.05F * static_cast<float>(1 + below(20));
        report.points.push_back({point, 1.0F, q, q});
      }
    }
    mission.captures.push_back(report);
  }
  for (const UavIndex uav : FirstUavs(kUavs)) {
    if (below(3) == 0) {
      mission.collided.push_back(uav);
    }
  }
  return mission;
}

/// The rule literally: of all captures that count, the best; of equal ones the earliest, then the first in fleet order.
std::vector<PointTally> brute_force(const Mission& mission, const RulesConfig& rules) {
  std::vector<PointTally> best(kPoints);
  for (const CaptureReport& report : mission.captures) {
    const bool lost = rules.collision_voids_score && std::ranges::count(mission.collided, report.uav) > 0;
    for (const CapturePoint& point : report.points) {
      PointTally& now = best[point.index];
      const bool earlier = report.tick < now.tick || (report.tick == now.tick && report.uav < now.uav);
      const bool better = point.q > now.q || (point.q == now.q && earlier);
      if (!lost && point.q >= 0.2F && better) {
        now = {point.q, report.uav, report.capture, report.tick};
      }
    }
  }
  return best;
}

void expect_tally(const ScoreTable& table, const std::vector<PointTally>& expected) {
  ASSERT_EQ(table.points(), expected);
  std::vector<double> by_uav(kUavs, 0.0);
  std::size_t detected = 0;
  for (const PointTally& tally : expected) {
    by_uav[tally.uav] += tally.q;
    detected += tally.q >= 0.2F;
  }
  EXPECT_EQ(table.points_detected(), detected);
  const std::vector<double> found = table.score_by_uav();
  for (const UavIndex uav : FirstUavs(kUavs)) {
    EXPECT_NEAR(found[uav], by_uav[uav], 1e-9);
  }
  EXPECT_EQ(table.score(), std::accumulate(found.begin(), found.end(), 0.0));
}

TEST(ScoreTable, AgreesWithBruteForce) {
  for (const bool voids : {true, false}) {
    RulesConfig rules;
    rules.collision_voids_score = voids;
    for (std::uint64_t key = 1; key <= 30; ++key) {
      const Mission mission = random_mission(key);
      ScoreTable table(kUavs, kPoints, rules);
      for (const CaptureReport& report : mission.captures) {
        table.add(report);
      }
      for (const std::size_t uav : mission.collided) {
        table.collide(UavIndex(uav));
      }
      expect_tally(table, brute_force(mission, rules));
    }
  }
}

/// Reports come in any order, some twice, with collisions between them. The reported changes alone give the same tally.
TEST(ScoreTable, OrderAndRepetitionDoNotMatter) {
  const RulesConfig rules;
  for (std::uint64_t key = 1; key <= 30; ++key) {
    const Mission mission = random_mission(key);
    RandomStream random(key, "score_table_order", 0, 0);
    std::vector<std::size_t> order(2 * mission.captures.size() + mission.collided.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size() - 1; i > 0; --i) {
      std::swap(order[i], order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1))]);
    }
    ScoreTable table(kUavs, kPoints, rules);
    std::vector<PointTally> rebuilt(kPoints);
    for (const std::size_t event : order) {
      const auto changes =
          event < mission.collided.size()
              ? table.collide(UavIndex(mission.collided[event]))
              : table.add(mission.captures[(event - mission.collided.size()) % mission.captures.size()]);
      for (const TallyChange& change : changes) {
        EXPECT_NE(rebuilt[change.point], change.now) << "the table reported a change that was none";
        rebuilt[change.point] = change.now;
      }
      ASSERT_EQ(rebuilt, table.points());
    }
    expect_tally(table, brute_force(mission, rules));
  }
}

TEST(ScoreTable, CollisionGivesThePointToTheNextBest) {
  ScoreTable table(3, 1, RulesConfig{});
  table.add({UavIndex{0}, 0, 100, 1, {{0, 1.0F, 0.6F, 0.6F}}});
  table.add({UavIndex{1}, 0, 200, 2, {{0, 1.0F, 0.9F, 0.9F}}});
  EXPECT_EQ(table.points()[0].uav, 1U);
  const auto changes = table.collide(UavIndex{1});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0], (TallyChange{0, {0.6F, UavIndex{0}, 0, 100}}));
  EXPECT_TRUE(table.add({UavIndex{1}, 1, 300, 3, {{0, 1.0F, 1.0F, 1.0F}}}).empty()) << "later captures are lost too";
  EXPECT_TRUE(table.collide(UavIndex{1}).empty());
  EXPECT_EQ(table.collide(UavIndex{0}), (std::vector<TallyChange>{{0, PointTally{}}}));
  EXPECT_EQ(table.score(), 0.0);
  EXPECT_EQ(table.points_detected(), 0U);
}

TEST(ScoreTable, ThresholdIsInclusive) {
  ScoreTable table(1, 2, RulesConfig{});
  table.add({UavIndex{0}, 0, 0, 0, {{0, 1.0F, 0.2F, 0.2F}, {1, 1.0F, 0.19999F, 0.19999F}}});
  EXPECT_EQ(table.points_detected(), 1U);
  EXPECT_EQ(table.points()[0].q, 0.2F);
}

TEST(ScoreTable, APointOfTooLowAQualityIsNotDetected) {
  RulesConfig rules;
  rules.min_point_score = 0.0;
  ScoreTable table(1, 3, rules);
  table.add({UavIndex{0}, 0, 0, 0, {{0, 1.0F, 0.2F, 0.2F}, {1, 1.0F, 0.05F, 0.05F}}});
  EXPECT_EQ(table.points_detected(), 1U);
  EXPECT_FLOAT_EQ(static_cast<float>(table.score()), 0.25F);
}

TEST(ScoreTable, RefusesUnknownUavsAndPoints) {
  ScoreTable table(2, 3, RulesConfig{});
  EXPECT_THROW(table.add({UavIndex{2}, 0, 0, 0, {}}), std::out_of_range);
  EXPECT_THROW(table.add({UavIndex{0}, 0, 0, 0, {{0, 1.0F, 1.0F, 1.0F}, {3, 1.0F, 1.0F, 1.0F}}}), std::out_of_range);
  EXPECT_THROW(table.collide(UavIndex{2}), std::out_of_range);
  RulesConfig lenient;
  lenient.collision_voids_score = false;
  EXPECT_THROW(ScoreTable(2, 3, lenient).collide(UavIndex{2}), std::out_of_range);
  EXPECT_EQ(table.score(), 0.0) << "a bad report must leave nothing behind";
}

}  // namespace
}  // namespace skein
