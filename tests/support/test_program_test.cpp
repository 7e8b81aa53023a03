#include "tests/support/test_program.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "tests/support/scratch_folder.hpp"

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

TEST(TestsInTurn, EveryTurnHasAllParametersOrOnlySomeIfAligned) {
  const std::set<std::string> all = {"one", "two"};
  for (std::size_t turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(parameters(turn, false), all);
    EXPECT_EQ(parameters(turn, true), std::set<std::string>{turn == 0 ? "one" : "two"});
  }
}

TEST(TestsInTurn, WithHalvesEachTestHasItsTurnOnceInTwiceAsManyTurns) {
  for (std::size_t turns = 1; turns <= 5; ++turns) {
    for (const std::size_t half : {0, 1}) {
      std::map<std::string, int> count;
      for (std::size_t turn = 1000; turn < 1000 + 2 * turns; ++turn) {
        const auto own = turn_in_half(turn, half);
        EXPECT_EQ(own.has_value(), turn % 2 == half);
        if (!own) continue;
        for (const std::string& test : tests_in_turn(kTests, *own, turns)) ++count[test];
      }
      EXPECT_EQ(count.size(), kTests.size()) << turns;
      for (const auto& [test, times] : count) EXPECT_EQ(times, 1) << test << " in " << turns;
    }
  }
}

TEST(TestsInTurn, ATurnOfTheOtherHalfRunsNoTests) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string file = " --file tests/support/test_program_test.cpp --gtest_filter=TemporaryFolder.WritesAFile*";
  const auto prints = [&](const std::string& options) {
    const ScratchFolder folder;
    const std::string out = (folder.path() / "out").string();
    EXPECT_EQ(std::system(("SKEIN_TURN=7 '" + program + "'" + file + options + " >'" + out + "'").c_str()), 0);
    std::ifstream in(out);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_NE(prints(" --half 1").find("1 test from"), std::string::npos);
  EXPECT_EQ(prints(" --half 0").find("test from"), std::string::npos);
  const int status = std::system(("SKEIN_TURN=1 '" + program + "' --half 2 2>/dev/null").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
}

TEST(TestsInTurn, AnInvalidNumberOfTurnsIsRefused) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  for (const std::string shares : {"0", "many"}) {
    const int status = std::system(("SKEIN_TURN=1 '" + program + "' --turns " + shares + " 2>/dev/null").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << shares;
  }
}

/// The next test also starts this one in a program of its own.
TEST(TemporaryFolder, WritesAFileAndAFolder) {
  std::ofstream(std::filesystem::temp_directory_path() / "file") << "left";
  std::filesystem::create_directory(std::filesystem::path(testing::TempDir()) / "folder");
  if (std::getenv("SKEIN_TEST_FAILS") != nullptr) FAIL();
}

TEST(TemporaryFolder, BelongsToOneProgramAndIsRemovedIfItsTestsPass) {
  const std::filesystem::path own = std::filesystem::temp_directory_path();
  EXPECT_TRUE(std::filesystem::equivalent(own, testing::TempDir()));
  EXPECT_TRUE(own.filename().string().starts_with("skein-test-")) << own;
  const ScratchFolder around;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const auto left_by = [&](const std::string& variables) {
    const std::string command =
        "env -u TEST_TMPDIR TMPDIR='" + around.path().string() + "' " + variables + " '" + program +
        "' --gtest_output= " + "--gtest_filter=TemporaryFolder.WritesAFileAndAFolder >/dev/null";
    [[maybe_unused]] const int status = std::system(command.c_str());
    std::size_t left = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(around.path())) left += entry.exists();
    return left;
  };
  EXPECT_EQ(left_by(""), 0U);
  EXPECT_EQ(left_by("SKEIN_TEST_FAILS=1"), 3U)
      << "after a failure, the folder with its file and its folder must remain";
}

}  // namespace
}  // namespace skein::test
