#include "cli/bench/planner_scores.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <random>
#include <sstream>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

const std::vector<PlannerScore> kBefore = {
    {"towers", "kios", 100.0, 120, 0, 0}, {"wild 3", "kios", 10.0, 20, 1, 2}, {"wild 4", "kios", 30.0, 40, 0, 1}};
const std::vector<PlannerScore> kNow = {{"towers", "kios", 90.0, 110, 0, 0},
                                        {"wild 3", "kios", 20.0, 25, 0, 0},
                                        {"wild 4", "kios", 28.0, 39, 0, 1},
                                        {"wild 5", "kios", 5.0, 9, 0, 0}};

TEST(PlannerScores, AreReadAsTheyAreWritten) {
  const ScratchDir folder;
  const auto file = folder.path() / "scores.csv";
  std::ofstream(file) << planner_scores_csv(kBefore);
  const auto read = read_planner_scores(file);
  ASSERT_EQ(read.size(), kBefore.size());
  EXPECT_EQ(planner_scores_csv(read), planner_scores_csv(kBefore));
}

TEST(PlannerScores, DamagedTablesAreNamedByLine) {
  const ScratchDir folder;
  const auto file = folder.path() / "scores.csv";
  const std::string header = "scene,planner,score,points,collisions,frozen_uavs\n";
  const std::map<std::string, std::string> tables = {{"", "no scores"},
                                                     {header, "no scores"},
                                                     {header.substr(0, header.size() - 1), "no scores"},
                                                     {"scene,score\n", "line 1"},
                                                     {header + "towers,kios,1,2,3,4\ntowers,kios,1,2,3\n", "line 3"},
                                                     {header + "towers,kios,x,2,3,4\n", "line 2"},
                                                     {header + "towers,kios,-1,2,3,4\n", "line 2"},
                                                     {header + "towers,kios,1,2,3e9,4\n", "line 2"},
                                                     {header + "towers,kios,1,2,3,1e300\n", "line 2"}};
  for (const auto& [text, part] : tables) {
    std::ofstream(file) << text;
    try {
      read_planner_scores(file);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

TEST(PlannerScores, OnlyRegularFilesAreRead) {
  const ScratchDir folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& file : {pipe, std::filesystem::path("/dev/zero"), folder.path()}) {
    EXPECT_THROW(read_planner_scores(file), InputError) << file;
  }
}

TEST(PlannerScores, TheSumsOfAKindOfSceneCountOnlyRowsOfBothTables) {
  std::ostringstream out;
  print_planner_scores(out, kBefore, kNow);
  std::map<std::string, std::vector<std::string>> lines;  // keyed by the first word of the line
  std::istringstream in(out.str());
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::vector<std::string> cells;
    for (std::string word; words >> word;) cells.push_back(word);
    if (!lines.contains(cells.at(0))) lines[cells.at(0)] = cells;
  }
  using Cells = std::vector<std::string>;
  EXPECT_EQ(lines.at("towers"),
            (Cells{"towers", "kios", "1", "100.0", "90.0", "-10.0", "%", "0", "->", "0", "0", "->", "0"}));
  EXPECT_EQ(lines.at("wild"),
            (Cells{"wild", "kios", "2", "40.0", "48.0", "+20.0", "%", "1", "->", "0", "3", "->", "1"}));
  EXPECT_NE(out.str().find("1   not in the table before"), std::string::npos) << out.str();
}

// A planner that no longer flies in a scene must not make its sums look better in silence.
TEST(PlannerScores, TheComparisonCountsTheRowsOfOnlyOneTable) {
  std::mt19937 random(13);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<PlannerScore> before, now;
    int only_before = 0, only_now = 0;
    for (int scene = 0; scene < 8; ++scene) {
      const PlannerScore score{"wild " + std::to_string(scene), "kios", 10.0, 20, 0, 0};
      const bool was = random() % 2 == 0, is = random() % 2 == 0;
      if (was) before.push_back(score);
      if (is) now.push_back(score);
      if (was && !is) ++only_before;
      if (is && !was) ++only_now;
    }
    std::ostringstream out;
    print_planner_scores(out, before, now);
    const auto expect = [&](int count, const std::string& words) {
      const std::string told = " " + std::to_string(count) + "   " + words;
      EXPECT_EQ(out.str().find(count == 0 ? words : told) != std::string::npos, count != 0) << told << out.str();
    };
    expect(only_now, "not in the table before");
    expect(only_before, "only in the table before");
  }
}

}  // namespace
}  // namespace skein::cli
