#include "core/text/suggestion.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

TEST(Suggestion, FindsTheNearestName) {
  const std::vector<std::string> known = {"mbs", "crane", "towers"};
  EXPECT_EQ(suggestion("tower", known), "did you mean 'towers'?");
  EXPECT_EQ(suggestion("twoers", known), "did you mean 'towers'?");
  EXPECT_EQ(suggestion("crain", known), "did you mean 'crane'?");
}

TEST(Suggestion, FindsANameWithoutItsUnit) {
  EXPECT_EQ(suggestion("max_acceleration", {"mass_kg", "max_acceleration_mps2"}),
            "did you mean 'max_acceleration_mps2'?");
}

TEST(Suggestion, ListsAllWhenNoneIsNear) {
  EXPECT_EQ(suggestion("hangar", {"mbs", "crane"}), "known are: mbs, crane");
  EXPECT_EQ(suggestion(std::string(100000, 'x'), {"mbs"}), "known are: mbs");
  EXPECT_EQ(suggestion("x", {"y", "ab"}), "known are: y, ab");  // a suggestion would replace the whole word
  EXPECT_EQ(suggestion("x", {}), "none is known");
}

TEST(Joined, LongListsEndWithANumber) {
  std::vector<std::string> words;
  EXPECT_EQ(joined_first(words), "");
  for (int i = 0; i < 10; ++i) words.push_back(std::to_string(i));
  EXPECT_EQ(joined_first(words), "0, 1, 2, 3, 4, 5, 6, 7, 8, 9");
  words.emplace_back("10");
  EXPECT_EQ(joined_first(words), "0, 1, 2, 3, 4, 5, 6, 7, 8 and 2 more");
  EXPECT_EQ(joined_first(words, 11), "0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10");
  EXPECT_EQ(joined_first(words, 5), "0, 1, 2, 3 and 7 more");
}

TEST(Counted, OneTakesTheSingular) {
  EXPECT_EQ(counted(0, "flight"), "0 flights");
  EXPECT_EQ(counted(1, "flight"), "1 flight");
  EXPECT_EQ(counted(2, "flight"), "2 flights");
}

}  // namespace
}  // namespace skein
