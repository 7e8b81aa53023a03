// Expressions over signals: their values, their margins, and the error messages for wrong ones.
#include "core/expressions/expression_parser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/scenario/scenario.hpp"

namespace skein {
namespace {

Scenario signal_fleet() {
  Scenario scenario;
  for (const char* name : {"jurong", "changi"}) {
    UavConfig uav;
    uav.name = name;
    scenario.fleet.push_back(uav);
  }
  return scenario;
}

class Expressions : public testing::Test {
 protected:
  Expression parse(const std::string& text) {
    signals_.clear();
    return parse_condition(text, scope_, signals_);
  }
  /// The margin of an expression whose signals all have this value.
  Margin margin(const std::string& text, double value = 0.0) {
    const Expression expression = parse(text);
    const std::vector<double> values(signals_.size(), value);
    return margin_at(expression, {values, values, values});
  }
  void refused(const std::string& text, std::size_t at, const std::string& words) {
    try {
      parse(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const ExpressionError& error) {
      EXPECT_EQ(error.at, at) << text << ": " << error.what();
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << text << ": " << error.what();
    }
  }

  const SignalNames names_{signal_fleet()};
  ExpressionScope scope_{.names = names_};
  std::vector<SignalUse> signals_;
};

TEST_F(Expressions, OperatorsHaveTheirPrecedence) {
  EXPECT_TRUE(margin("1 + 2 * 3 == 7").holds);
  EXPECT_TRUE(margin("-2 - 3 == -5 and 8 / 2 / 2 == 2").holds);
  EXPECT_TRUE(margin("1 == 1 or 1 == 2 and 1 == 3").holds);
  EXPECT_FALSE(margin("(1 == 1 or 1 == 2) and 1 == 3").holds);
  EXPECT_FALSE(margin("not 1 == 1 or 1 == 2").holds);
  EXPECT_TRUE(margin("min(3, 1 + 1) == 2 and max(3 m, 50 cm) == 3 m and abs(-4) == 4").holds);
  EXPECT_TRUE(margin("80 % == 0.8 and 180 deg > 3.14 rad and 2 kB == 2000 B and 36 km / 3600 s == 10 m/s").holds);
}

TEST_F(Expressions, AMarginIsTheDistanceToTheOppositeTruth) {
  EXPECT_DOUBLE_EQ(margin("separation > 2 m", 5.0).margin, 3.0);
  EXPECT_DOUBLE_EQ(margin("separation < 2 m", 5.0).margin, -3.0);
  EXPECT_DOUBLE_EQ(margin("held == 2", 5.0).margin, -3.0);
  EXPECT_DOUBLE_EQ(margin("held >= 5 and held < 7", 5.0).margin, 0.0);
  EXPECT_TRUE(margin("held >= 5 and held < 7", 5.0).holds);
  EXPECT_DOUBLE_EQ(margin("alive(changi) and z(changi) > 0 m", 5.0).margin, 5.0)
      << "a true condition without numbers has an infinite margin";
  EXPECT_EQ(margin("alive(changi)", 1.0).margin, INFINITY);
  EXPECT_EQ(margin("not alive(changi)", 1.0).margin, -INFINITY);
}

/// A random condition and its opposite, which has opposite comparisons instead of a `not` around the condition.
struct Drawn {
  std::string text, opposite;
};
Drawn drawn(std::mt19937_64& random, int depth) {
  static const std::vector<std::pair<std::string, std::string>> marks = {{"<", ">="}, {"<=", ">"},  {">", "<="},
                                                                         {">=", "<"}, {"==", "!="}, {"!=", "=="}};
  if (depth == 0 || random() % 4 == 0) {
    const auto& [mark, other] = marks[random() % marks.size()];
    const std::string left = "held(" + std::string(random() % 2 == 0 ? "jurong" : "changi") + ")";
    const std::string right = " " + std::to_string(random() % 5);
    return {left + " " + mark + right, left + " " + other + right};
  }
  const Drawn a = drawn(random, depth - 1), b = drawn(random, depth - 1);
  if (random() % 5 == 0) return {"not (" + a.text + ")", "not (" + a.opposite + ")"};
  const bool all = random() % 2 == 0;
  return {"(" + a.text + (all ? ") and (" : ") or (") + b.text + ")",
          "(" + a.opposite + (all ? ") or (" : ") and (") + b.opposite + ")"};
}

TEST_F(Expressions, TheSignOfAMarginShowsTheTruthAndANegationChangesTheSign) {
  std::mt19937_64 random(1);
  int decided = 0;
  for (int round = 0; round < 2000; ++round) {
    const Drawn condition = drawn(random, 4);
    const double value = static_cast<double>(random() % 5);
    const Margin one = margin(condition.text, value), other = margin(condition.opposite, value);
    EXPECT_NE(one.holds, other.holds) << condition.text;
    EXPECT_DOUBLE_EQ(one.margin, -other.margin) << condition.text;
    if (one.margin != 0.0) {
      EXPECT_EQ(one.holds, one.margin > 0.0) << condition.text;
    }
    decided += one.margin != 0.0;
  }
  EXPECT_GT(decided, 500);
}

// A change of the signals by less than the margin cannot change the truth value.
TEST_F(Expressions, AChangeBelowTheMarginKeepsTheTruth) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 2000; ++round) {
    const Expression condition = parse(drawn(random, 3).text);
    std::vector<double> values(signals_.size());
    for (double& value : values) value = static_cast<double>(random() % 500) / 100.0;
    const Margin before = margin_at(condition, {values, values, values});
    for (double& value : values) {
      value += 0.999 * std::abs(before.margin) * (2.0 * static_cast<double>(random() % 1000) / 999.0 - 1.0);
    }
    EXPECT_EQ(margin_at(condition, {values, values, values}).holds, before.holds || before.margin == 0.0) << round;
  }
}

TEST_F(Expressions, GainsCountFromTheAnchorAndRisesFromTheExchangeBefore) {
  const Expression gain = parse("gain(held(changi)) >= 2");
  const std::vector<double> one = {1.0}, two = {2.0}, three = {3.0};
  EXPECT_TRUE(margin_at(gain, {three, three, one}).holds);
  EXPECT_FALSE(margin_at(gain, {three, three, two}).holds);
  const Expression rises = parse("rises(held(changi))");
  EXPECT_TRUE(margin_at(rises, {two, one, three}).holds);
  EXPECT_FALSE(margin_at(rises, {two, two, one}).holds);
  EXPECT_FALSE(margin_at(rises, {one, two, one}).holds);
  EXPECT_TRUE(margin_at(parse("falls(held(changi) >= 2)"), {one, two, one}).holds);
}

/// A defined operand decides the result if it can. An undefined result neither holds nor fails.
TEST_F(Expressions, AQuotientByZeroIsUndefinedAndSoIsItsOpposite) {
  for (const char* mark : {"<", "<=", ">", ">=", "==", "!="}) {
    for (const char* zero : {"1 / held", "held / held", "-1 / held", "min(1, 1 / held)", "max(held / held, 1)",
                             "abs(1 / held) + 1", "gain(1 / held)", "2 * (0 - 1 / held)"}) {
      const std::string undefined = std::string(zero) + " " + mark + " 1";
      EXPECT_FALSE(margin(undefined, 0.0).is_defined) << undefined;
      EXPECT_FALSE(margin(undefined, 0.0).holds) << undefined;
      EXPECT_FALSE(margin("not (" + undefined + ")", 0.0).holds) << undefined;
      EXPECT_FALSE(margin("not (" + undefined + ")", 0.0).is_defined) << undefined;
      EXPECT_FALSE(margin("rises(" + undefined + ") or not rises(" + undefined + ")", 0.0).is_defined) << undefined;
      EXPECT_TRUE(margin("held == 0 or " + undefined, 0.0).holds) << undefined;
      EXPECT_TRUE(margin("not (held == 1 and " + undefined + ")", 0.0).holds) << undefined;
      EXPECT_FALSE(margin("held == 0 and " + undefined, 0.0).is_defined) << undefined;
      EXPECT_FALSE(margin("held == 1 or " + undefined, 0.0).is_defined) << undefined;
      EXPECT_TRUE(margin(undefined, 2.0).is_defined) << undefined;
    }
  }
  EXPECT_TRUE(margin("separation > 5 m and separation == separation(jurong)", INFINITY).holds);
  EXPECT_FALSE(margin("separation - separation(jurong) < 5 m", INFINITY).is_defined);
}

TEST_F(Expressions, ADivisionByAWrittenZeroIsRefused) {
  for (const char* text : {"0/0 > 1", "held/0 > 1"}) refused(text, std::string(text).find('/') + 1, "divided by 0");
  refused("1 m / 0 m > 1", 6, "divided by 0");
  refused("held > 1 / (2 - 2)", 12, "divided by 0");
}

TEST_F(Expressions, EachSignalHasOneSlot) {
  parse("held(changi) > 1 and held(jurong) > held(changi) and held > 2");
  ASSERT_EQ(signals_.size(), 3U);
  EXPECT_EQ(signals_[1].text(), "held(jurong)");
  EXPECT_EQ(signals_[2].text(), "held");
  parse("sent(all, gcs, /plan) > 1");
  EXPECT_EQ(signals_[0].arguments, (std::vector<std::string>{"", "gcs", "/plan"}));
}

TEST_F(Expressions, VariablesAndParametersHaveTheValuesGiven) {
  scope_.variables = {{"u", "changi"}};
  scope_.parameters = {{"least", {5.0, kMetres}}};
  EXPECT_TRUE(margin("z(u) > least", 6.0).holds);
  EXPECT_EQ(signals_[0].text(), "z(changi)");
  refused("held(u) > least", 10, "units do not fit");
}

TEST_F(Expressions, WrongExpressionsAreRefusedWithTheColumn) {
  refused("", 0, "a signal, a number or '('");
  refused("separatoin > 1 m", 0, "did you mean 'separation'?");
  refused("separation > 1", 13, "write a unit behind the number: m, cm or km");
  refused("separation > 3 min", 13, "write a unit behind the number: m, cm or km");
  refused("separation > 1 s", 13, "the left side is in m, the right side in s");
  refused("separation > 1x", 14, "there is no unit 'x'");
  refused("separation", 10, "must be compared");
  refused("separation > ", 13, "not the end");
  refused("held(chagni) > 1", 5, "there is no UAV 'chagni'; did you mean 'changi'?");
  refused("link(jurong) ", 0, "names are missing: the signal is link(node, node)");
  refused("held(jurong, changi) > 1", 13, "too many names: the signal is held([uav])");
  refused("link(jurong, jurong)", 13, "'jurong' is named twice: link(node, node) is about two different ones");
  refused("separation(changi, changi) > 1 m", 19, "'changi' is named twice");
  refused("sent(gcs, gcs, /plan) > 1", 10, "'gcs' is named twice");
  parse("sent(all, all, /plan) > 1");
  refused("sent(jurong, gcs, plan) > 1", 18, "here must be a topic like '/plan'");
  refused("held > 1 and 3", 13, "each side of 'and' must be a condition");
  refused("(held > 1) + 3 > 1", 1, "each term of a sum must be a number");
  refused("held = 1", 5, "write '=='");
  refused("1 < held < 3", 9, "one comparison at a time");
  refused("(held > 1", 9, "here must be ')', not the end");
  refused("held > 1 held", 9, "here must be the end");
  refused("alive(changi) > 0", 0, "must be a number, and this is a condition");
  refused("result(sim_time_s) > 3", 21, "write a unit");
  refused("held + 1 m > 3", 7, "units do not fit");
  refused("score ≥ 3", 6, "not '≥'");
  refused("held > 1 \xE2\x89", 9, "not '\xE2\x89'");
  refused(std::string(500, '(') + "1", 65, "nested too deeply");
}

/// The tree of a chain of operators is as deep as the chain is long. A very deep tree would overflow the stack.
TEST_F(Expressions, LongChainsAreReadAndLongerOnesRefused) {
  const auto chain = [](const std::string& link, std::size_t letters) {
    std::string text = "held > 1";
    while (text.size() + link.size() <= letters) text += link;
    return text;
  };
  for (const std::string link : {" or held>1", " and held>1", "+1", "*1"}) {
    EXPECT_EQ(margin(chain(link, 4000), 0.0).holds, false) << link;
    refused(chain(link, 1'000'000), 4000, "too long");
  }
}

TEST_F(Expressions, ALiveExpressionMayUseOnlySignalsKnownDuringARun) {
  scope_.live_only = true;
  for (const SignalInfo& info : signal_table()) {
    try {
      parse(std::string(info.name) + "(nobody)");  // wrong in any case
      ADD_FAILURE() << info.name;
    } catch (const ExpressionError& error) {
      const bool unknown = std::string(error.what()).find("known only after the run") != std::string::npos;
      EXPECT_EQ(unknown, !info.is_live) << info.name << ": " << error.what();
    }
  }
  refused("rises(held)", 0, "'rises' looks back");
}

}  // namespace
}  // namespace skein
