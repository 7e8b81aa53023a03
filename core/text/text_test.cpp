#include "core/text/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

#include "core/text/utf8.hpp"
#include "core/types.hpp"

namespace skein {
namespace {

/// A random number of any magnitude and either sign.
double any_number(std::mt19937& random) {
  const double mantissa = static_cast<double>(random()) / 1e9 - 2.0;
  return mantissa * std::pow(10.0, static_cast<int>(random() % 40) - 20);
}

TEST(Text, TheShortestTextOfANumberReadsBackAsTheSameNumber) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = any_number(random);
    ASSERT_EQ(parse_number(shortest(value)), value);
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    ASSERT_LE(shortest(value).size(), std::strlen(digits));
  }
}

TEST(Text, FixedAndSignificantRoundLikePrintf) {
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    const double value = any_number(random);
    const int digits = static_cast<int>(random() % 6);
    char fixed_text[64], significant_text[64];
    std::snprintf(fixed_text, sizeof fixed_text, "%.*f", digits, value);
    std::snprintf(significant_text, sizeof significant_text, "%.*g", digits + 1, value);
    ASSERT_EQ(significant(value, digits + 1), significant_text);
    // printf writes a sign before a zero, as in "-0.0"; fixed() does not.
    ASSERT_EQ(fixed(value, digits), fixed_text + (std::stod(fixed_text) == 0.0 && value < 0.0 ? 1 : 0));
    const std::string at_most = fixed_at_most(value, digits);
    ASSERT_EQ(std::stod(at_most), std::stod(fixed_text));
    ASSERT_TRUE(at_most.find('.') == std::string::npos || !at_most.ends_with('0')) << at_most;
  }
}

TEST(Text, ZeroHasNoSignAndWholeNumbersHaveNoPoint) {
  EXPECT_EQ(fixed(-0.001, 1), "0.0");
  EXPECT_EQ(fixed(-0.5, 1), "-0.5");
  EXPECT_EQ(fixed_at_most(-0.001, 1), "0");
  EXPECT_EQ(fixed_at_most(100.0, 0), "100");
  EXPECT_EQ(fixed_at_most(-2.96, 1), "-3");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.3");
}

TEST(Text, ParseNumberRefusesTextsThatAreNotExactlyOneNumber) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500.0);
  for (const char* text : {"", "+1", " 1", "1 ", "0x10", "nan", "inf", "1e999", "1,5", "one"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(Text, ASplitTextCanBeJoinedAgain) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (unsigned n = random() % 12; n > 0; --n) text += "a,b"[random() % 3];
    const std::vector<std::string> parts = split(text);
    std::string joined;
    for (const std::string& part : parts) joined += "," + part;
    ASSERT_EQ(joined, "," + text);
    ASSERT_EQ(parts.size(), 1u + static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')));
  }
}

TEST(Text, ShellWordQuotesWhatAShellWouldSplitOrChange) {
  EXPECT_EQ(shell_word("kios:voxel_m=4,x=+1"), "kios:voxel_m=4,x=+1");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("$(x)"), "'$(x)'");
}

/// For words of any characters.
TEST(Text, ShellWordsReadsBackWhatShellLineWrites) {
  std::mt19937 random(5);
  const std::string letters = "ab '\"\\$*?~=;|&<>(){}#!`-/.";
  for (int round = 0; round < 300; ++round) {
    std::vector<std::string> words(random() % 5);
    for (std::string& word : words) {
      for (std::size_t left = random() % 7; left > 0; --left) word += letters[random() % letters.size()];
    }
    EXPECT_EQ(shell_words(shell_line(words)), words) << shell_line(words);
  }
  EXPECT_EQ(shell_words("  a\t \"b c\" "), (std::vector<std::string>{"a", "b c"}));
  for (const char* line : {"a 'b", "a; b", "a | b", "$a", "`a`", "\"$(a)\""}) {
    EXPECT_THROW(shell_words(line), InputError) << line;
  }
}

TEST(Text, ControlCharactersAreShownAsQuestionMarks) {
  EXPECT_EQ(printable(std::string("a\x01\0b\n\tü", 8)), "a??b\n\tü");
}

TEST(Text, InvalidUtf8IsShownAsQuestionMarks) {
  for (const char* text : {"", "plain", "\u00e4\u20ac\U0001f681", "\x7f\xc2\x80", "\xef\xbf\xbf\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(as_utf8(text), text);
    EXPECT_TRUE(is_utf8(text)) << text;
  }
  for (const auto& [text, shown] :
       {std::pair("caf\xe9.yaml", "caf?.yaml"), std::pair("\xe4\xb8", "??"), std::pair("\xc0\x80", "??"),
        std::pair("\xed\xa0\x80", "???"), std::pair("\xf4\x90\x80\x80", "????"),
        std::pair("a\x80\xc3\xa4\xff", "a?\xc3\xa4?")}) {
    EXPECT_EQ(as_utf8(text), shown);
    EXPECT_EQ(printable(text), shown);
    EXPECT_FALSE(is_utf8(text)) << shown;
  }
}

TEST(Text, ShortenedCutsALongTextBetweenTwoCharacters) {
  EXPECT_EQ(shortened("orbit"), "orbit");
  EXPECT_EQ(shortened(std::string(100000, 'a')), std::string(80, 'a') + "...");
  EXPECT_EQ(shortened(std::string(79, 'a') + "ä" + std::string(9, 'a')), std::string(79, 'a') + "...");
}

}  // namespace
}  // namespace skein
