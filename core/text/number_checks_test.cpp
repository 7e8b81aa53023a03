#include "core/text/number_checks.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

TEST(NumberChecks, NameTheMistakeInAFewWords) {
  for (const char* good : {"1", "0.5", "1e3"}) EXPECT_EQ(check_positive(good), "") << good;
  for (const char* bad : {"0", "-1", "x", "", "nan", "inf", "1e999", "1x"}) {
    const std::string wrong = check_positive(bad);
    EXPECT_EQ(wrong, "'" + std::string(bad) + "' must be a number above 0");
  }
  EXPECT_EQ(check_not_negative("0"), "");
  EXPECT_EQ(check_not_negative("-0.5"), "'-0.5' must be a number of at least 0");
}

TEST(NumberChecks, ARangeHasOnlyNumbersInDecimalDigits) {
  const auto check = number_within(0.5, 100.0);
  for (const char* good : {"0.5", "1", "1e2"}) EXPECT_EQ(check(good), "") << good;
  for (const char* bad : {"nan", "inf", "0.4", "100.1", "0x10", "", "1x"}) {
    EXPECT_EQ(check(bad), "'" + std::string(bad) + "' must be a number within [0.5, 100]");
  }
}

TEST(NumberChecks, TimeoutsHaveAMaximum) {
  for (const char* good : {"0", "0.5", "36000"}) EXPECT_EQ(check_timeout_or_none(good), "") << good;
  for (const char* bad : {"-1", "36001", "1e10", "inf", "nan", ""}) {
    EXPECT_EQ(check_timeout_or_none(bad), "'" + std::string(bad) + "' must be a number within [0, 36000]");
  }
}

TEST(NumberChecks, SeedsAreWholeNumbersOf64BitsInDecimalDigits) {
  for (const char* good : {"0", "7", "18446744073709551615"}) EXPECT_EQ(check_seed(good), "") << good;
  for (const char* bad : {"-1", "18446744073709551616", "1.5", "1e3", "0x10", "", "x"}) {
    EXPECT_EQ(check_seed(bad), "'" + std::string(bad) + "' must be a whole number within [0, 18446744073709551615]");
  }
  EXPECT_EQ(check_seed("010"), "'010' must be a whole number in decimal digits, without a zero before it");
}

}  // namespace
}  // namespace skein
