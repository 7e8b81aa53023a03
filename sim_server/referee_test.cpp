// The ledger: which captures enter, their numbers, and their scores.
#include "sim_server/referee.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace skein::sim {
namespace {

Detection detection(std::uint32_t point, double q, bool improved) {
  return {point, 1.0, q, 0.5 + 0.5 * q, q, static_cast<float>(q), improved};
}

Capture capture(Tick tick, std::vector<Detection> detections) { return {tick, std::move(detections)}; }

TEST(Referee, TheLedgerHasOnlyCapturesThatImprovedAPoint) {
  Referee referee(0, 2, 10, RulesConfig{});
  EXPECT_FALSE(referee.enter(UavIndex{0}, capture(41, {})));
  EXPECT_FALSE(referee.enter(UavIndex{0}, capture(82, {detection(3, 0.5, false)})));
  EXPECT_TRUE(referee.ledger().empty());
  const auto report = referee.enter(UavIndex{0}, capture(123, {detection(3, 0.5, false), detection(7, 0.75, true)}));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->points, (std::vector<CapturePoint>{{7, 1.0F, 0.75F, 0.75F, 0.875F}}));
  EXPECT_EQ(report->tick, 123);
  ASSERT_EQ(referee.ledger().size(), 1U);
  EXPECT_EQ(referee.ledger()[0].capture, *report);
  EXPECT_EQ(referee.earned().score(), 0.75);
}

TEST(Referee, TheRefereeNumbersItsEntriesWithoutGaps) {
  Referee referee(3, 3, 1000, RulesConfig{});
  std::set<std::uint64_t> tokens;
  std::vector<std::uint64_t> of_uav(3, 0);
  Tick tick = 0;
  std::size_t entered = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const UavIndex uav(i * 7 % 3);
    tick += i % 2 == 0 ? 20 : 0;
    const auto report = referee.enter(uav, capture(tick, {detection(i, 0.4, i % 5 != 0)}));
    EXPECT_EQ(report.has_value(), i % 5 != 0);
    if (report) {
      EXPECT_EQ(report->uav, uav);
      EXPECT_EQ(report->capture, of_uav[uav]++);
      EXPECT_TRUE(tokens.insert(report->token).second) << "a token must not come twice";
      const LedgerEntry& entry = referee.ledger().back();
      EXPECT_EQ(entry, (LedgerEntry{entered++, tick, uav, false, *report}));
    }
  }
  std::size_t stored = 0;
  for (const UavIndex uav : FirstUavs(3)) {
    const auto reports = referee.reports(uav);
    stored += reports.size();
    for (std::size_t i = 0; i < reports.size(); ++i) {
      EXPECT_EQ(reports[i].uav, uav);
      EXPECT_EQ(reports[i].capture, i);
    }
  }
  EXPECT_EQ(stored, entered);
}

TEST(Referee, TokensFollowTheSeed) {
  const auto token = [](std::uint64_t seed) {
    Referee referee(seed, 1, 1, RulesConfig{});
    return referee.enter(UavIndex{0}, capture(0, {detection(0, 0.5, true)}))->token;
  };
  EXPECT_EQ(token(1), token(1));
  EXPECT_NE(token(1), token(2));
}

TEST(Referee, ACollisionEndsAUavsCapturesAndVoidsItsPoints) {
  Referee referee(0, 2, 2, RulesConfig{});
  referee.enter(UavIndex{0}, capture(41, {detection(0, 0.9, true)}));
  referee.enter(UavIndex{1}, capture(41, {detection(0, 0.5, true), detection(1, 1.0, true)}));
  EXPECT_EQ(referee.earned().score(), static_cast<double>(0.9F) + 1.0);
  EXPECT_TRUE(referee.enter_collision(UavIndex{0}, 60));
  EXPECT_FALSE(referee.enter_collision(UavIndex{0}, 61)) << "only the first counts";
  EXPECT_FALSE(referee.enter(UavIndex{0}, capture(82, {detection(1, 1.0, true)})));
  ASSERT_EQ(referee.ledger().size(), 3U);
  EXPECT_EQ(referee.ledger()[2], (LedgerEntry{2, 60, UavIndex{0}, true, {}}));
  EXPECT_EQ(referee.earned().score(), 1.5);
  EXPECT_EQ(referee.earned().score_by_uav(), (std::vector<double>{0.0, 1.5}));
}

TEST(Referee, AnEntryThatIsEarlierThanTheLastIsRefused) {
  Referee referee(0, 2, 2, RulesConfig{});
  referee.enter(UavIndex{0}, capture(41, {detection(0, 0.9, true)}));
  referee.enter(UavIndex{1}, capture(41, {detection(0, 0.9, true)}));
  EXPECT_THROW(referee.enter(UavIndex{1}, capture(40, {detection(1, 0.9, true)})), std::logic_error);
  EXPECT_THROW(referee.enter_collision(UavIndex{1}, 40), std::logic_error);
  EXPECT_EQ(referee.ledger().size(), 2U);
}

}  // namespace
}  // namespace skein::sim
