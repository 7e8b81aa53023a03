#include "tests/support/test_program.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace skein::test {
namespace {

const std::vector<std::string> kTests = {"V/S.a/one", "V/S.a/two", "V/S.b/one", "V/S.b/two",
                                         "V/S.c/one", "V/S.c/two", "S.d",       "S/0.e"};

TEST(TestsInTurn, EachHasItsTurnOnceInEveryRound) {
  for (std::size_t turns = 1; turns <= 9; ++turns) {
    for (const bool aligned : {false, true}) {
      std::map<std::string, int> count;
      for (std::size_t turn = 1000; turn < 1000 + turns; ++turn) {
        for (const std::string& test : tests_in_turn(kTests, turn, turns, aligned)) ++count[test];
      }
      EXPECT_EQ(count.size(), kTests.size()) << turns;
      for (const auto& [test, times] : count) EXPECT_EQ(times, 1) << test << " in " << turns;
    }
  }
}

/// The parameters with which tests run in a turn.
std::set<std::string> parameters(std::size_t turn, bool aligned) {
  std::set<std::string> seen;
  for (const std::string& test : tests_in_turn(kTests, turn, 2, aligned)) {
    if (test.starts_with("V/")) seen.insert(test.substr(test.rfind('/') + 1));
  }
  return seen;
}

TEST(TestsInTurn, EveryTurnSeesEveryParameterOrOnlySome) {
  const std::set<std::string> all = {"one", "two"};
  for (std::size_t turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(parameters(turn, false), all);
    EXPECT_EQ(parameters(turn, true), std::set<std::string>{turn == 0 ? "one" : "two"});
  }
}

}  // namespace
}  // namespace skein::test
