#include "core/text/number_checks.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

TEST(NumberChecks, SayInAFewWordsWhatIsWrong) {
  for (const char* good : {"1", "0.5", "1e3"}) EXPECT_EQ(check_positive(good), "") << good;
  for (const char* bad : {"0", "-1", "x", "", "nan", "inf", "1e999", "1x"}) {
    const std::string wrong = check_positive(bad);
    EXPECT_EQ(wrong, "'" + std::string(bad) + "' must be a number above 0");
  }
  EXPECT_EQ(check_not_negative("0"), "");
  EXPECT_EQ(check_not_negative("-0.5"), "'-0.5' must be a number of at least 0");
}

}  // namespace
}  // namespace skein
