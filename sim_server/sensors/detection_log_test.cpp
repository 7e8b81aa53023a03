#include "sim_server/sensors/detection_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/math/random_stream.hpp"
#include "sim_server/referee.hpp"

namespace skein::sim {
namespace {

constexpr std::uint32_t kPoints = 60;

/// Captures of a camera that sees random points in random quality, as Camera makes them.
class RandomCamera {
 public:
  explicit RandomCamera(std::uint64_t seed) : random_(seed, "detections", 0), best_(kPoints, 0.0F) {}

  Capture capture(Tick tick) {
    Capture capture{tick, {}};
    for (std::uint32_t point = 0; point < kPoints; ++point) {
      if (random_.uniform(0.0, 1.0) > 0.1) continue;
      const double q = random_.uniform(0.2, 1.0);
      const bool improved = static_cast<float>(q) > best_[point];
      best_[point] = std::max(best_[point], static_cast<float>(q));
      capture.detections.push_back(
          {.point = point, .q_blur = 1.0, .q_res = q, .q = q, .best = best_[point], .improved = improved});
    }
    return capture;
  }
  const std::vector<float>& best() const { return best_; }

 private:
  RandomStream random_;
  std::vector<float> best_;
};

TEST(DetectionLog, TheLogKeepsTheOrderOfDetectionAndTheBestScore) {
  RandomCamera camera(1);
  DetectionLog log;
  std::vector<std::uint32_t> first_seen;
  for (Tick tick = 0; tick < 50; ++tick) {
    const Capture capture = camera.capture(tick);
    const std::vector<DetectionLog::Entry> before(log.entries().begin(), log.entries().end());
    log.add(capture);
    for (const Detection& d : capture.detections) {
      if (std::ranges::find(first_seen, d.point) == first_seen.end()) first_seen.push_back(d.point);
    }
    ASSERT_EQ(log.entries().size(), first_seen.size());
    for (std::size_t number = 0; number < first_seen.size(); ++number) {
      EXPECT_EQ(log.entries()[number].point, first_seen[number]);
      EXPECT_EQ(log.entries()[number].best, camera.best()[first_seen[number]]);
      if (number < before.size()) {
        EXPECT_GE(log.entries()[number].best, before[number].best);
      }
    }
  }
  EXPECT_GT(first_seen.size(), kPoints / 2);
}

TEST(DetectionLog, TheLogHandsOutEachDetectionOnce) {
  RandomCamera camera(2);
  DetectionLog log;
  EXPECT_TRUE(log.take_seen().empty());
  for (Tick tick = 0; tick < 20; ++tick) {
    std::set<std::uint32_t> points;
    for (int captures = 0; captures < 2; ++captures) {
      const Capture capture = camera.capture(tick);
      log.add(capture);
      for (const Detection& d : capture.detections) points.insert(d.point);
    }
    const std::vector<std::uint32_t> seen = log.take_seen();
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    ASSERT_EQ(seen.size(), points.size());
    for (const std::uint32_t number : seen) EXPECT_TRUE(points.contains(log.entries()[number].point));
    EXPECT_TRUE(log.take_seen().empty());
  }
}

TEST(DetectionLog, ReportsHaveTheUavsNumbersOfPointsNotTheScenesIndices) {
  RandomCamera camera(3);
  DetectionLog log;
  Referee referee(0, 1, kPoints, RulesConfig{});
  std::map<std::uint32_t, std::uint32_t> told;  // number to point
  for (Tick tick = 0; tick < 30; ++tick) {
    const Capture capture = camera.capture(tick);
    log.add(capture);
    const auto report = referee.enter(UavIndex{0}, capture);
    if (!report) continue;
    const CaptureReport handed = log.as_told(*report);
    ASSERT_EQ(handed.points.size(), report->points.size());
    for (std::size_t i = 0; i < handed.points.size(); ++i) {
      EXPECT_EQ(log.entries()[handed.points[i].index].point, report->points[i].index);
      EXPECT_EQ(handed.points[i].q, report->points[i].q);
      const auto [known, fresh] = told.emplace(handed.points[i].index, report->points[i].index);
      EXPECT_EQ(known->second, report->points[i].index);
      if (fresh) {
        EXPECT_EQ(known->first, told.size() - 1) << "in the order of detection, without gaps";
      }
    }
    EXPECT_EQ(handed.token, report->token);
  }
  EXPECT_EQ(told.size(), log.entries().size()) << "what is seen for the first time is always reported";
}

}  // namespace
}  // namespace skein::sim
