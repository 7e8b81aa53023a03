#include "station/scoreboard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace skein::station {
namespace {

constexpr std::size_t kUavs = 3, kPoints = 40;

CaptureReport capture(UavIndex uav, std::uint64_t number, Tick tick, std::vector<CapturePoint> points) {
  return {uav, number, tick, 1000 * (uav + 1) + number, std::move(points)};
}

CapturePoint point(std::uint32_t index, float q) { return {index, q, 1.0F, q}; }

LedgerEntry entry(std::uint64_t index, const CaptureReport& report) {
  return {index, report.tick, report.uav, false, report};
}

LedgerEntry collision(std::uint64_t index, UavIndex uav, Tick tick) { return {index, tick, uav, true, {}}; }

Scoreboard board() { return Scoreboard(kUavs, kPoints, RulesConfig{}); }

TEST(Scoreboard, AReportThatEqualsAStandingEntryCountsAndIsAcknowledged) {
  Scoreboard score = board();
  const CaptureReport report = capture(UavIndex{1}, 0, 100, {point(3, 0.5F), point(7, 0.25F)});
  score.add_entry(entry(0, report));
  score.add_report(1, report);
  const StepOutcome outcome = score.end_step(120, 1);
  EXPECT_TRUE(outcome.score_changed);
  EXPECT_EQ(outcome.digest.size(), 32U);
  EXPECT_EQ(outcome.acks[1], std::vector<std::uint64_t>{0});
  EXPECT_TRUE(outcome.acks[0].empty());
  ASSERT_EQ(outcome.records.size(), 1U);
  EXPECT_EQ(outcome.records[0], (TallyRecord{120, entry(0, report)}));
  EXPECT_DOUBLE_EQ(score.delivered().score(), 0.75);
  EXPECT_EQ(score.timeline().back(), (TimelinePoint{120, 2, 0.75}));
  EXPECT_EQ(score.audit(score.ledger()[0]).delivered, Tick{120});
}

TEST(Scoreboard, AnEarnedPointIsNotYetDelivered) {
  Scoreboard score = board();
  score.add_entry(entry(0, capture(UavIndex{0}, 0, 10, {point(1, 0.5F)})));
  const StepOutcome outcome = score.end_step(20, 1);
  EXPECT_FALSE(outcome.score_changed);
  EXPECT_TRUE(outcome.digest.empty());
  EXPECT_EQ(score.delivered().score(), 0.0);
  EXPECT_DOUBLE_EQ(score.earned().score(), 0.5);
  EXPECT_FALSE(score.audit(score.ledger()[0]).delivered);
}

TEST(Scoreboard, AReportThatDiffersFromItsEntryOrComesFromAnotherUavIsRefused) {
  const CaptureReport genuine = capture(UavIndex{1}, 4, 100, {point(3, 0.5F)});
  const CaptureReport of_another = capture(UavIndex{0}, 0, 90, {point(3, 0.9F)});
  struct Case {
    Refusal reason;
    std::size_t source;
    CaptureReport report;
  };
  const auto with = [&](auto change) {
    CaptureReport report = genuine;
    change(report);
    return report;
  };
  const std::vector<Case> cases = {
      {Refusal::borrowed, 2, genuine},
      {Refusal::borrowed, 2, with([](CaptureReport& r) { r.uav = UavIndex{2}; })},
      {Refusal::borrowed, 1, of_another},
      {Refusal::borrowed, 1, with([](CaptureReport& r) { r.token = 1000; })},
      {Refusal::unknown, 1, with([](CaptureReport& r) { r.token ^= 0x10000; })},
      {Refusal::unknown, 1, capture(UavIndex{1}, 9, 100, {point(3, 1.0F)})},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.uav = UavIndex{0}; })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.uav = UavIndex{77}; })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.capture = 5; })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.tick = 99; })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.points[0].q = 0.6F; })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.points[0].q_blur = 0.6F; })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.points[0].q_res = 0.6F; })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.points[0].index = 4; })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.points.push_back(point(5, 0.5F)); })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.points.clear(); })},
      {Refusal::altered, 1, with([](CaptureReport& r) { r.points[0].index = 1u << 30; })},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Scoreboard score = board();
    score.add_entry(entry(0, of_another));
    score.add_entry(entry(1, genuine));
    score.add_report(cases[i].source, cases[i].report);
    for (Tick tick = 120; tick < 220; tick += 20) {
      const StepOutcome outcome = score.end_step(tick, 2);
      EXPECT_FALSE(outcome.score_changed) << i;
      EXPECT_TRUE(outcome.records.empty()) << i;
      for (const auto& acks : outcome.acks) EXPECT_TRUE(acks.empty()) << i;
    }
    for (const Refusal reason : {Refusal::unknown, Refusal::borrowed, Refusal::altered}) {
      EXPECT_EQ(score.refused(reason), reason == cases[i].reason ? 1U : 0U) << i << to_string(reason);
    }
    // audit() says why the station refused a report. A report with an unknown token belongs to no capture.
    const std::size_t claimed = cases[i].report.token == of_another.token ? 0 : 1;
    for (std::size_t known = 0; known < 2; ++known) {
      const bool told = cases[i].reason != Refusal::unknown && known == claimed;
      EXPECT_EQ(score.audit(score.ledger()[known]).refused, told ? std::optional(cases[i].reason) : std::nullopt) << i;
    }
    // The genuine report counts nevertheless.
    score.add_report(1, genuine);
    EXPECT_TRUE(score.end_step(300, 2).score_changed) << i;
  }
}

TEST(Scoreboard, AReportMayComeBeforeItsEntry) {
  const CaptureReport report = capture(UavIndex{0}, 0, 100, {point(1, 0.5F)});
  {  // the entry is here, but not valid yet: the report waits without a limit
    Scoreboard score = board();
    score.add_entry(entry(0, report));
    score.add_report(0, report);
    for (Tick tick = 100; tick < 300; tick += 20) EXPECT_TRUE(score.end_step(tick, 0).acks[0].empty());
    EXPECT_EQ(score.end_step(300, 1).acks[0].size(), 1U);
  }
  {  // no entry yet: the report waits for a limited time
    Scoreboard score = board();
    score.add_report(0, report);
    for (int step = 0; step < Scoreboard::kPatience; ++step) {
      EXPECT_TRUE(score.end_step(100 + step, 0).acks[0].empty());
    }
    score.add_entry(entry(0, report));
    EXPECT_EQ(score.end_step(110, 1).acks[0].size(), 1U);
    EXPECT_EQ(score.refused(Refusal::unknown), 0U);
  }
}

TEST(Scoreboard, ADuplicateIsAcknowledgedAgainAndChangesNothing) {
  Scoreboard score = board();
  const CaptureReport report = capture(UavIndex{2}, 0, 100, {point(1, 0.5F)});
  score.add_entry(entry(0, report));
  score.add_report(2, report);
  score.add_report(2, report);  // in the same step
  EXPECT_EQ(score.end_step(120, 1).records.size(), 1U);
  score.add_report(2, report);
  const StepOutcome again = score.end_step(140, 1);
  EXPECT_EQ(again.acks[2], std::vector<std::uint64_t>{0});
  EXPECT_TRUE(again.records.empty());
  EXPECT_FALSE(again.score_changed);
  EXPECT_EQ(score.duplicates(), 2U);
  EXPECT_EQ(score.reports_received(), 3U);
}

TEST(Scoreboard, ACollisionTakesThePointsBackAndGivesThemToTheNextBest) {
  Scoreboard score = board();
  const CaptureReport first = capture(UavIndex{0}, 0, 100, {point(1, 0.9F), point(2, 0.9F)});
  const CaptureReport second = capture(UavIndex{1}, 0, 105, {point(1, 0.5F)});
  score.add_entry(entry(0, first));
  score.add_entry(entry(1, second));
  score.add_entry(collision(2, UavIndex{0}, 130));
  score.add_report(0, first);
  score.add_report(1, second);
  score.end_step(120, 2);
  EXPECT_EQ(score.delivered().points_detected(), 2U);
  EXPECT_FALSE(score.is_void(UavIndex{0}));
  const StepOutcome crash = score.end_step(140, 3);
  EXPECT_TRUE(crash.score_changed);
  ASSERT_EQ(crash.records.size(), 1U);
  EXPECT_TRUE(crash.records[0].entry.collision);
  EXPECT_FLOAT_EQ(static_cast<float>(score.delivered().score()), 0.5F);
  EXPECT_EQ(score.delivered().score_by_uav()[0], 0.0);
  EXPECT_TRUE(score.is_void(UavIndex{0}));
  EXPECT_FLOAT_EQ(static_cast<float>(score.earned().score()), 0.5F);
}

TEST(Scoreboard, ALedgerThatContradictsItselfOrTheRunIsAnError) {
  Scoreboard score = board();
  score.add_entry(entry(0, capture(UavIndex{0}, 0, 10, {point(1, 0.5F)})));
  score.add_entry(entry(0, capture(UavIndex{0}, 0, 10, {point(1, 0.5F)})));
  EXPECT_THROW(score.add_entry(entry(0, capture(UavIndex{0}, 0, 10, {point(1, 0.6F)}))), std::invalid_argument);
  EXPECT_THROW(score.add_entry(entry(1, capture(UavIndex{9}, 0, 10, {}))), std::invalid_argument);
  EXPECT_THROW(score.add_entry(entry(1, capture(UavIndex{0}, 1, 10, {point(kPoints, 0.5F)}))), std::invalid_argument);
  EXPECT_THROW(score.end_step(20, 2), std::logic_error);
}

TEST(Scoreboard, AJournalRecordOfAnUnknownUavOrPointIsAnError) {
  Scoreboard score = board();
  EXPECT_THROW(score.restore({20, entry(0, capture(UavIndex{9}, 0, 10, {}))}), std::invalid_argument);
  EXPECT_THROW(score.restore({20, entry(0, capture(UavIndex{0}, 0, 10, {point(kPoints, 0.5F)}))}),
               std::invalid_argument);
  EXPECT_THROW(score.restore({20, collision(0, UavIndex(kUavs), 10)}), std::invalid_argument);
  EXPECT_EQ(score.reports_received(), 0U);
  EXPECT_EQ(score.delivered().score(), 0.0);
}

/// A random run: a ledger, and for each step the entries that are valid and the reports that arrive.
struct Mission {
  struct Step {
    Tick tick;
    std::uint64_t upto;
    std::vector<std::pair<std::size_t, CaptureReport>> reports;
  };
  std::vector<LedgerEntry> ledger;
  std::vector<Step> steps;
};

Mission random_mission(unsigned seed) {
  std::mt19937 random(seed);
  Mission run;
  std::vector<std::uint64_t> captures(kUavs, 0);
  std::vector<CaptureReport> on_the_way;
  for (Tick tick = 0; tick < 1200; tick += 20) {
    for (int n = static_cast<int>(random() % 3); n > 0; --n) {
      const UavIndex uav(random() % kUavs);
      if (random() % 40 == 0) {
        run.ledger.push_back(collision(run.ledger.size(), uav, tick));
        continue;
      }
      CaptureReport report = capture(uav, captures[uav]++, tick, {});
      for (std::uint32_t index = random() % 5; index < kPoints; index += 1 + random() % 20) {
        report.points.push_back(point(index, 0.2F + 0.05F * static_cast<float>(random() % 16)));
      }
      run.ledger.push_back(entry(run.ledger.size(), report));
      on_the_way.push_back(report);
    }
    Mission::Step step{tick + 20, run.ledger.size(), {}};
    for (const CaptureReport& report : on_the_way) {
      if (random() % 3 == 0) step.reports.emplace_back(random() % 10 == 0 ? 0 : report.uav, report);
    }
    std::erase_if(on_the_way, [&](const CaptureReport&) { return random() % 3 == 0; });
    run.steps.push_back(step);
  }
  return run;
}

TEST(Scoreboard, TheOrderOfArrivalWithinAStepDoesNotMatter) {
  double scored = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Mission run = random_mission(seed);
    std::mt19937 random(seed + 1000);
    Scoreboard in_order = board(), shuffled = board();
    for (const LedgerEntry& known : run.ledger) in_order.add_entry(known);
    std::vector<LedgerEntry> ledger = run.ledger;
    std::ranges::shuffle(ledger, random);
    for (const LedgerEntry& known : ledger) shuffled.add_entry(known);
    for (const Mission::Step& step : run.steps) {
      auto reports = step.reports;
      for (const auto& [source, report] : reports) in_order.add_report(source, report);
      std::ranges::shuffle(reports, random);
      for (const auto& [source, report] : reports) shuffled.add_report(source, report);
      const StepOutcome a = in_order.end_step(step.tick, step.upto), b = shuffled.end_step(step.tick, step.upto);
      EXPECT_EQ(a.digest, b.digest);
      EXPECT_EQ(a.records, b.records);
      EXPECT_EQ(a.acks, b.acks);
      EXPECT_EQ(a.score_changed, !a.digest.empty());
    }
    EXPECT_EQ(in_order.delivered().points(), shuffled.delivered().points());
    EXPECT_EQ(in_order.timeline(), shuffled.timeline());
    scored += in_order.delivered().score();
  }
  EXPECT_GT(scored, 100.0) << "the runs have too few points to show anything";
}

TEST(Scoreboard, AStationThatWasKilledGoesOnAsIfNothingHadHappened) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Mission run = random_mission(seed);
    Scoreboard steady = board(), killed = board();
    std::vector<TallyRecord> journal;
    for (const LedgerEntry& known : run.ledger) {
      steady.add_entry(known);
      killed.add_entry(known);
    }
    for (std::size_t s = 0; s < run.steps.size(); ++s) {
      if (s % 13 == 7) {
        killed = board();
        for (const TallyRecord& record : journal) killed.restore(record);
        const auto reported = [](const TallyRecord& record) { return !record.entry.collision; };
        EXPECT_EQ(killed.reports_received(), std::ranges::count_if(journal, reported));
        for (const LedgerEntry& known : run.ledger) killed.add_entry(known);
      }
      const Mission::Step& step = run.steps[s];
      for (const auto& [source, report] : step.reports) {
        steady.add_report(source, report);
        killed.add_report(source, report);
      }
      const StepOutcome a = steady.end_step(step.tick, step.upto), b = killed.end_step(step.tick, step.upto);
      EXPECT_EQ(a.digest, b.digest) << seed << " " << s;
      EXPECT_EQ(a.acks, b.acks);
      journal.insert(journal.end(), b.records.begin(), b.records.end());
    }
    EXPECT_EQ(steady.delivered().points(), killed.delivered().points());
    EXPECT_EQ(steady.timeline(), killed.timeline());
    EXPECT_EQ(steady.earned().score(), killed.earned().score());
  }
}

}  // namespace
}  // namespace skein::station
