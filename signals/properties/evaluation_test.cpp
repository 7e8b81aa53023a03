// Compares outcomes, margins and vacuous verdicts with a second, naive implementation of the definitions.
#include "signals/properties/evaluation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "signals/properties/property_parser.hpp"

namespace skein::properties {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Outcome = Verdict::Outcome;

Scenario fleet() {
  Scenario scenario;
  scenario.duration_s = 60.0;
  for (const char* name : {"a", "b"}) {
    UavConfig uav;
    uav.name = name;
    scenario.fleet.push_back(uav);
  }
  return scenario;
}

/// A run with given signals, keyed by their text. Each has one value per second.
class GivenRun final : public RunSignals {
 public:
  explicit GivenRun(std::map<std::string, std::vector<double>> signals) : signals_(std::move(signals)) {}

  const std::vector<double>& values(const SignalUse& signal) override { return signals_.at(signal.text()); }
  std::size_t exchanges() const override { return signals_.begin()->second.size(); }
  double period_s() const override { return 1.0; }
  std::optional<double> healed_s() const override { return healed; }

  std::optional<double> healed = 0.0;

 private:
  std::map<std::string, std::vector<double>> signals_;
};

Verdict judged(const std::string& text, GivenRun& run) {
  const std::vector<Property> properties = parse_property("it", text, fleet());
  std::vector<Verdict> verdicts;
  for (const Property& property : properties) verdicts.push_back(evaluate(property, run));
  return worst_of(verdicts);
}

Verdict judged(const std::string& text, std::map<std::string, std::vector<double>> signals,
               std::optional<double> healed = 0.0) {
  GivenRun run(std::move(signals));
  run.healed = healed;
  return judged(text, run);
}

TEST(Evaluation, AlwaysHasTheLeastAndEventuallyTheGreatestMarginInItsWindow) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 500; ++round) {
    std::vector<double> held(20);
    for (double& value : held) value = static_cast<double>(random() % 100);
    const std::size_t from = random() % 10, to = from + 1 + random() % 9;
    const std::string window = " from " + std::to_string(from) + " s to " + std::to_string(to) + " s";
    const auto begin = held.begin() + static_cast<std::ptrdiff_t>(from),
               end = held.begin() + static_cast<std::ptrdiff_t>(to) + 1;
    const double least = *std::min_element(begin, end), greatest = *std::max_element(begin, end);
    if (least == greatest) continue;
    const Verdict always = judged("always held >= 50" + window, {{"held", held}});
    EXPECT_EQ(always.margin, least - 50.0);
    EXPECT_EQ(always.outcome, least >= 50.0 ? Outcome::holds : Outcome::fails);
    EXPECT_EQ(held[static_cast<std::size_t>(always.at_s)], least);
    const Verdict never = judged("never held >= 50" + window, {{"held", held}});
    EXPECT_EQ(never.margin, 50.0 - greatest);
    EXPECT_EQ(never.outcome, greatest < 50.0 ? Outcome::holds : Outcome::fails);
    const Verdict eventually = judged("eventually held >= 50" + window, {{"held", held}});
    EXPECT_EQ(eventually.margin, greatest - 50.0);
    EXPECT_EQ(eventually.outcome, greatest >= 50.0 ? Outcome::holds : Outcome::fails);
    const Verdict finally = judged("finally held >= 50" + window, {{"held", held}});
    EXPECT_EQ(finally.margin, held[to] - 50.0);
    EXPECT_EQ(finally.outcome, held[to] >= 50.0 ? Outcome::holds : Outcome::fails);
    EXPECT_EQ(finally.at_s, static_cast<double>(to));
    const Verdict sometimes = judged("sometimes held >= 50" + window, {{"held", held}});
    EXPECT_EQ(sometimes.outcome, greatest >= 50.0 ? Outcome::holds : Outcome::vacuous);
  }
}

TEST(Evaluation, UntilHasTheMarginOfItsBestInstant) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 500; ++round) {
    std::vector<double> a(12), b(12);
    for (double& value : a) value = static_cast<double>(random() % 20);
    for (double& value : b) value = static_cast<double>(random() % 20);
    double best = -kInfinity;
    bool holds = false;
    for (std::size_t t = 0; t < a.size(); ++t) {
      double lesser = b[t] - 15.0;
      bool all = b[t] > 15.0;
      for (std::size_t before = 0; before < t; ++before) {
        lesser = std::min(lesser, a[before] - 3.0);
        all = all && a[before] > 3.0;
      }
      best = std::max(best, lesser);
      holds = holds || all;
    }
    const Verdict verdict = judged("held(a) > 3 until held(b) > 15", {{"held(a)", a}, {"held(b)", b}});
    EXPECT_EQ(verdict.outcome, holds ? Outcome::holds : Outcome::fails) << round;
    if (best != 0.0) {
      EXPECT_EQ(verdict.margin, best) << round;
    }
  }
}

// A change of the signal by less than the margin does not change the verdict.
TEST(Evaluation, ChangesBelowTheMarginKeepTheVerdict) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 1000; ++round) {
    std::vector<double> held(10);
    for (double& value : held) value = static_cast<double>(random() % 1000) / 10.0;
    for (const char* text : {"always held > 20", "eventually held > 80 from 2 s to 9 s", "held < 90 until held > 60"}) {
      const Verdict before = judged(text, {{"held", held}});
      std::vector<double> moved = held;
      for (double& value : moved) {
        value += 0.99 * std::abs(before.margin) * (2.0 * static_cast<double>(random() % 1000) / 999.0 - 1.0);
      }
      if (before.margin != 0.0) {
        EXPECT_EQ(judged(text, {{"held", moved}}).outcome, before.outcome) << text;
      }
    }
  }
}

TEST(Evaluation, WheneverIsJudgedFromEachTimeThatItsConditionBecomesTrue) {
  const std::vector<double> restarts = {0, 0, 1, 1, 1, 1, 2, 2, 2, 2}, captures = {0, 1, 1, 1, 2, 2, 2, 2, 2, 3};
  const std::string text = "whenever rises(restarts), eventually gain(captures) >= 1 within ";
  const auto with = [&](const std::string& time) {
    return judged(text + time, {{"restarts", restarts}, {"captures", captures}});
  };
  EXPECT_EQ(with("3 s").outcome, Outcome::holds) << "the captures grow at 4 s and at 9 s";
  const Verdict late = with("2 s");
  EXPECT_EQ(late.outcome, Outcome::fails) << "after the second restart, the captures grow only after 3 s";
  EXPECT_NE(late.reason.find("from 6 to 8 s"), std::string::npos) << late.reason;
  EXPECT_EQ(with("1 s").outcome, Outcome::fails);
}

TEST(Evaluation, GainsCountFromTheBeginningOfTheWindow) {
  const std::vector<double> captures = {0, 5, 5, 6, 7};
  EXPECT_EQ(judged("eventually gain(captures) >= 2 from 1 s to 4 s", {{"captures", captures}}).margin, 0.0);
  EXPECT_EQ(judged("eventually gain(captures) >= 3 from 1 s to 4 s", {{"captures", captures}}).outcome, Outcome::fails);
  EXPECT_EQ(judged("eventually gain(captures) >= 2 after heal", {{"captures", captures}}, 1.0).outcome, Outcome::holds);
  EXPECT_EQ(judged("eventually gain(captures) >= 2 after heal", {{"captures", captures}}, 3.0).outcome, Outcome::fails);
}

TEST(Evaluation, APropertyThatTheRunDoesNotDecideIsVacuousWithAReason) {
  const std::vector<double> rising = {0, 1, 2, 3}, still = {2, 2, 2, 2};
  const auto reason = [](const Verdict& verdict) {
    EXPECT_EQ(verdict.outcome, Outcome::vacuous);
    return verdict.reason;
  };
  EXPECT_NE(reason(judged("always held < 3", {{"held", still}})).find("ever changed"), std::string::npos);
  EXPECT_EQ(judged("always held < 1", {{"held", still}}).outcome, Outcome::fails)
      << "a property that fails is not vacuous";
  EXPECT_EQ(judged("always held < 3 and result(score) > 1", {{"held", rising}, {"result(score)", still}}).outcome,
            Outcome::fails);
  EXPECT_EQ(judged("always result(score) > 1", {{"result(score)", still}}).outcome, Outcome::holds)
      << "result() is constant in every run, so it need not change";
  EXPECT_NE(reason(judged("sometimes held > 9", {{"held", rising}})).find("never reached"), std::string::npos);
  EXPECT_NE(reason(judged("whenever held > 9, always held < 3", {{"held", rising}})).find("never became true"),
            std::string::npos);
  EXPECT_NE(reason(judged("always held < 9 after 30 s", {{"held", rising}})).find("ended at 3 s"), std::string::npos);
  EXPECT_NE(reason(judged("always held < 9 after heal", {{"held", rising}}, std::nullopt)).find("lasts to the end"),
            std::string::npos);
  EXPECT_NE(reason(judged("eventually held > 9 within 5 s", {{"held", rising}})).find("before it could be decided"),
            std::string::npos);
  EXPECT_EQ(judged("eventually held > 9 within 2 s", {{"held", rising}}).outcome, Outcome::fails);
  EXPECT_NE(reason(judged("finally held >= 0 within 5 s", {{"held", rising}})).find("before it could be decided"),
            std::string::npos)
      << "what holds before the window's end may not hold at its end";
  EXPECT_EQ(judged("eventually held >= 2 within 5 s", {{"held", rising}}).outcome, Outcome::holds)
      << "the value was reached in time";
}

TEST(Evaluation, AnUndefinedComparisonNeitherHoldsNorFails) {
  const std::vector<double> from_zero = {0, 1, 2}, to_zero = {2, 1, 0}, never_zero = {3, 2, 1};
  const std::map<std::string, std::vector<double>> run = {
      {"held(a)", from_zero}, {"held(b)", to_zero}, {"captures(a)", never_zero}};
  const auto unclear = [&](const std::string& text, double at_s) {
    const Verdict verdict = judged(text, run);
    EXPECT_EQ(verdict.outcome, Outcome::vacuous) << text;
    EXPECT_TRUE(verdict.is_unclear) << text;
    EXPECT_NE(verdict.reason.find("is undefined at " + std::to_string(static_cast<int>(at_s)) + " s"),
              std::string::npos)
        << text << ": " << verdict.reason;
  };
  unclear("always 1 / held(a) > 0.1", 0.0);
  unclear("never 1 / held(a) > 5", 0.0);
  unclear("always not (1 / held(b) > 5)", 2.0);
  unclear("eventually 1 / held(a) > 5 from 0 s to 2 s", 0.0);
  unclear("sometimes 1 / held(b) > 5", 2.0);
  unclear("whenever 1 / held(a) > 5, always held(b) < 9", 0.0);
  unclear("1 / held(a) > 5 until held(b) < 2", 1.0);
  unclear("for u in uavs, always 1 / held(u) > 0.1", 0.0);
  // If the other exchanges decide the property, the undefined one does not matter.
  EXPECT_EQ(judged("always 1 / held(a) > 0.9", run).outcome, Outcome::fails);
  EXPECT_EQ(judged("never 1 / held(a) > 0.1", run).outcome, Outcome::fails);
  EXPECT_EQ(judged("eventually 1 / held(a) > 0.9", run).outcome, Outcome::holds);
  EXPECT_EQ(judged("always 1 / held(a) > 0.1 from 1 s to 2 s", run).outcome, Outcome::holds);
  EXPECT_EQ(judged("always 1 / captures(a) > 0.1", run).outcome, Outcome::holds);
}

TEST(Evaluation, TheUavWithTheWorstMarginCounts) {
  const std::vector<double> low = {0, 1, 2}, high = {3, 4, 5}, still = {1, 1, 1};
  const Verdict failing = judged("for u in uavs, always held(u) < 4", {{"held(a)", low}, {"held(b)", high}});
  EXPECT_EQ(failing.outcome, Outcome::fails);
  EXPECT_EQ(failing.bound, "u = b");
  const Verdict near = judged("for u in uavs, always held(u) < 9", {{"held(a)", low}, {"held(b)", high}});
  EXPECT_EQ(near.outcome, Outcome::holds);
  EXPECT_EQ(near.bound, "u = b");
  EXPECT_EQ(near.margin, 4.0);
  const Verdict half = judged("for u in uavs, always held(u) < 9", {{"held(a)", still}, {"held(b)", low}});
  EXPECT_EQ(half.outcome, Outcome::holds) << "vacuous for UAV a, but UAV b decides the property";
}

TEST(Evaluation, ABooleanSignalHasAnInfiniteMargin) {
  const Verdict verdict = judged("eventually alive(a)", {{"alive(a)", {0, 1, 1}}});
  EXPECT_EQ(verdict.outcome, Outcome::holds);
  EXPECT_EQ(verdict.margin, kInfinity);
  EXPECT_EQ(verdict.at_s, 1.0);
}

TEST(Evaluation, MarginsOverTimeAreThoseOfTheCondition) {
  GivenRun run({{"held", {1, 2, 3}}});
  EXPECT_EQ(margins_over_time(parse_property("it", "always held < 3", fleet())[0], run),
            (std::vector<double>{2, 1, 0}));
  EXPECT_EQ(margins_over_time(parse_property("it", "never held < 3", fleet())[0], run),
            (std::vector<double>{-2, -1, 0}));
}

// `alive` changes only in a collision. Nevertheless, `always alive` is not vacuous in a run in which UAVs fly and none
// collides.
TEST(Evaluation, AFlightWithoutCollisionDecidesAlive) {
  const auto flown = [](const std::vector<double>& distance, const std::vector<double>& alive) {
    return judged("for u in uavs, always alive(u)",
                  {{"alive(a)", alive}, {"distance(a)", distance}, {"alive(b)", {1, 1, 1}}, {"distance(b)", {0, 0, 0}}})
        .outcome;
  };
  EXPECT_EQ(flown({0, 1, 2}, {1, 1, 1}), Outcome::holds);
  EXPECT_EQ(flown({0, 0, 0}, {1, 1, 1}), Outcome::vacuous) << "no UAV flies";
  EXPECT_EQ(flown({0, 1, 1}, {1, 1, 0}), Outcome::fails);
}

TEST(Evaluation, UnlessEndsTheWindow) {
  const auto outcome = [](const std::string& text, const std::vector<double>& held, const std::vector<double>& member) {
    return judged(text, {{"held", held}, {"member(a)", member}}).outcome;
  };
  const std::string eventually = "eventually held >= 2 unless member(a) within 3 s";
  EXPECT_EQ(outcome(eventually, {0, 1, 2, 2, 2}, {0, 0, 0, 1, 1}), Outcome::holds) << "held >= 2 became true first";
  EXPECT_EQ(outcome(eventually, {0, 1, 1, 2, 2}, {0, 0, 1, 1, 1}), Outcome::vacuous)
      << "the condition of unless became true first";
  EXPECT_EQ(outcome(eventually, {0, 1, 1, 1, 2}, {0, 0, 0, 0, 1}), Outcome::fails)
      << "neither condition became true in time";
  EXPECT_EQ(outcome(eventually, {2, 2, 2, 2, 2}, {1, 1, 1, 1, 1}), Outcome::vacuous)
      << "the condition of unless is true from the beginning";
  const std::string always = "always held < 2 unless member(a)";
  EXPECT_EQ(outcome(always, {0, 1, 2, 0, 0}, {0, 0, 0, 1, 1}), Outcome::fails);
  EXPECT_EQ(outcome(always, {0, 1, 0, 2, 2}, {0, 0, 0, 1, 1}), Outcome::holds)
      << "held < 2 until the condition of unless became true";
  const Verdict excused = judged(eventually, {{"held", {0, 1, 1}}, {"member(a)", {0, 0, 1}}});
  EXPECT_NE(excused.reason.find("not exercised"), std::string::npos) << excused.reason;
}

// If no signal changes, a property is vacuous, unless its condition requires a constant value.
TEST(Evaluation, AConditionThatRequiresAConstantValueIsNotVacuous) {
  const std::vector<double> still = {3, 3, 3, 3}, moving = {3, 4, 5, 6};
  for (const char* text : {"always gain(held) == 0", "finally held == 3", "always held == 3 and held < 9",
                           "for u in uavs, always gain(held(a)) == 0"}) {
    EXPECT_EQ(judged(text, {{"held", still}, {"held(a)", still}}).outcome, Outcome::holds) << text;
    EXPECT_EQ(judged(text, {{"held", moving}, {"held(a)", moving}}).outcome, Outcome::fails) << text;
  }
  for (const char* text : {"always held < 9", "always held(a) == held", "always gain(held) <= 2"}) {
    EXPECT_EQ(judged(text, {{"held", still}, {"held(a)", still}}).outcome, Outcome::vacuous) << text;
  }
}

}  // namespace
}  // namespace skein::properties
