// docs/porting-from-caric.md: runs its commands unchanged; the planner on the page flies with explorers and
// photographers, scores, and has the same digest each time.
#include <regex>
#include <set>

#include "workspace_fixture.hpp"

namespace skein::test {
namespace {

class Porting : public WorkspaceTest {};

/// The words of the `./skein run` commands in a page's blocks.
std::vector<Arguments> runs_of(const std::string& page) {
  std::vector<Arguments> runs;
  std::istringstream lines(text_of(source_path(page)));
  bool in_block = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) in_block = line == "```sh";
    const std::string command = "./skein run ";
    if (!in_block || !line.starts_with(command)) continue;
    static const std::regex kWord(R"('([^']*)'|(\S+))");
    const std::string rest = line.substr(command.size(), line.find(" #") - command.size());
    Arguments words;
    for (std::sregex_iterator word(rest.begin(), rest.end(), kWord), end; word != end; ++word) {
      words.push_back((*word)[1].matched ? (*word)[1].str() : (*word)[2].str());
    }
    runs.push_back(words);
  }
  return runs;
}

TEST_F(Porting, CommandsOfThePageFly) {
  const std::vector<Arguments> runs = runs_of("docs/porting-from-caric.md");
  ASSERT_FALSE(runs.empty());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    SCOPED_TRACE(testing::PrintToString(runs[i]));
    SkeinRun& done = run_with("cyclonedds", "page" + std::to_string(i), runs[i], 0, {{"SKEIN_DURATION", "20"}});
    EXPECT_EQ(done.result()["status"], "completed") << done.err();
    EXPECT_TRUE(done.result()["lost_members"].empty()) << done.err();
  }
}

TEST_F(Porting, ThePortedBaselineScoresTheSameEachTime) {
  const Arguments flight = {"towers", "--planner", "ros:skein_ros_baseline/uav,gcs=ros:skein_ros_baseline/gcs",
                            "--duration", "60"};
  std::set<std::string> digests;
  for (const char* middleware : {"cyclonedds", "fastrtps"}) {
    const bool other = std::string(middleware) == "cyclonedds";
    SkeinRun& done = run_with(middleware, middleware, joined(flight, {"--dds", other ? "fastdds" : "cyclonedds"}));
    const Json result = done.result();
    EXPECT_TRUE(result["deterministic"]) << done.err();
    EXPECT_TRUE(result["collisions"].empty()) << result["collisions"];
    EXPECT_GT(result["score"], 20.0);
    EXPECT_EQ(result["score"], result["score_earned"]) << "a UAV did not come back in time to deliver its captures";
    for (const Json& uav : result["uavs"]) EXPECT_EQ(uav["commands_rejected"], 0) << uav["name"];
    // The planner assigns regions to teams: explorers arrive first, and photographers have left their starts.
    for (const Json& uav : result["uavs"]) EXPECT_GT(uav["distance_m"], 10.0) << uav["name"];
    digests.insert(done.digest());
  }
  EXPECT_EQ(digests.size(), 1U);
}

}  // namespace
}  // namespace skein::test
