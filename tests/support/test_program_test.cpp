#include "tests/support/test_program.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace skein::test {
namespace {

const std::vector<std::string> kTests = {"a/one", "a/two", "b/one", "b/two", "c/one", "c/two", "d"};

TEST(TestsInTurn, EachHasItsTurnOnceInEveryRound) {
  for (std::size_t turns = 1; turns <= 9; ++turns) {
    for (const std::size_t first : {0u, 1u, 1000u}) {
      std::map<std::string, int> count;
      for (std::size_t turn = first; turn < first + turns; ++turn) {
        for (const std::string& test : tests_in_turn(kTests, turn, turns)) ++count[test];
      }
      EXPECT_EQ(count.size(), kTests.size()) << turns;
      for (const auto& [test, times] : count) EXPECT_EQ(times, 1) << test << " in " << turns;
    }
  }
}

TEST(TestsInTurn, EveryTurnSeesEveryParameter) {
  for (std::size_t turn = 0; turn < 2; ++turn) {
    std::set<std::string> parameters;
    for (const std::string& test : tests_in_turn(kTests, turn, 2)) parameters.insert(test.substr(1));
    EXPECT_TRUE(parameters.contains("/one") && parameters.contains("/two")) << turn;
  }
}

}  // namespace
}  // namespace skein::test
