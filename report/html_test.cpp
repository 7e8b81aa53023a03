#include "report/html.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace skein::report {
namespace {

TEST(Html, CharactersWithAMeaningInMarkupAreEscaped) {
  EXPECT_EQ(escaped("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(escaped("Zürich\n"), "Zürich\n");
  EXPECT_EQ(escaped(std::string("a\x01\0b", 4)), "a??b");
}

TEST(Html, NumbersHaveFewDigits) {
  EXPECT_EQ(fixed(3.14159, 2), "3.14");
  EXPECT_EQ(fixed(std::nullopt, 1), "–");
  EXPECT_EQ(coordinate(3.0), "3");
  EXPECT_EQ(coordinate(-2.96), "-3");
  EXPECT_EQ(coordinate(0.25), "0.2");
}

TEST(Html, LongTextsAreCutBetweenCharacters) {
  EXPECT_EQ(shortened("kios", 4), "kios");
  EXPECT_EQ(shortened("kios:voxel", 6), "kios:…");
  EXPECT_EQ(shortened("äöüäöü", 3), "äö…");
}

TEST(Html, AnAxisContainsItsValuesAndHasRoundTicks) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const double size = std::pow(10.0, static_cast<double>(random() % 9) - 3.0);
    const double a = size * (static_cast<double>(random() % 2001) / 1000.0 - 0.5);
    const double b = a + size * static_cast<double>(random() % 1000) / 1000.0;
    const Axis axis = nice_axis(a, b);
    ASSERT_LT(axis.low, axis.high) << a << " " << b;
    ASSERT_LE(axis.low, a + 1e-9 * size) << b;
    ASSERT_GE(axis.high, b - 1e-9 * size) << a;
    const std::vector<double> ticks = axis.ticks();
    ASSERT_GE(ticks.size(), 2u);
    ASSERT_LE(ticks.size(), 10u) << a << " " << b;
    ASSERT_NEAR(ticks.back(), axis.high, 1e-9 * (std::abs(axis.high) + size));
    for (const double tick : ticks) {
      ASSERT_NEAR(std::stod(axis.label(tick)), tick, 1e-6 * axis.step) << "the label has too few digits for the tick";
      ASSERT_NEAR(std::remainder(tick, axis.step), 0.0, 1e-6 * axis.step);
    }
  }
}

TEST(Html, AnAxisBeginsAtZeroUnlessThatWastesHalfOfIt) {
  EXPECT_EQ(nice_axis(300, 800).low, 0.0);
  EXPECT_EQ(nice_axis(780, 800).low, 780.0);
  EXPECT_EQ(nice_axis(0, 0).low, 0.0);
  EXPECT_LT(nice_axis(812, 812).low, 812.0);
  EXPECT_GT(nice_axis(812, 812).high, 812.0);
}

}  // namespace
}  // namespace skein::report
