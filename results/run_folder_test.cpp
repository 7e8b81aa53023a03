// Names of programs, and which files of a folder are a run's.
#include "results/run_folder.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

TEST(ProgramNames, EachMemberHasItsProgram) {
  for (const char* member : {"comm_router", "station", "gcs", "jurong", "sim", "uav_agent"}) {
    EXPECT_EQ(programs::member_name(programs::program_of(member)), member);
  }
  EXPECT_EQ(programs::program_of("gcs"), programs::kGroundAgent);
  EXPECT_EQ(programs::program_of("jurong"), "uav_agent-jurong");
  for (const char* program : programs::kServers) EXPECT_FALSE(programs::is_agent(program)) << program;
  EXPECT_TRUE(programs::is_agent(programs::kGroundAgent));
}

TEST(RunFolder, KnowsTheFilesOfARunAlsoIfHalfWritten) {
  std::vector<std::string> files = {
      "result.json",          "score.csv",          "losses.csv",   "scene.json",      "trajectories.csv",
      "digests.csv",          "events.csv",         "captures.csv", "station.journal", "comm_router.counts",
      "capture_messages.csv", "score_timeline.csv", "report.html",  "work.csv",        "one_process.log"};
  for (const char* program : {"sim_server", "station", "comm_router", "uav_agent-jurong", "uav_agent-gcs"}) {
    files.push_back(run_folder::report_file(program));
    files.push_back(run_folder::log_file(program));
  }
  files.push_back(run_folder::map_file("jurong"));
  for (int life = 0; life < 3; ++life) files.push_back(run_folder::maps_file("jurong", life));
  for (const std::string& file : files) {
    EXPECT_TRUE(run_folder::is_of_a_run(file)) << file;
    EXPECT_TRUE(run_folder::is_of_a_run(file + ".tmp4711")) << file;
    EXPECT_FALSE(run_folder::is_of_a_run("my_" + file)) << file;
  }
  for (const char* other :
       {"notes.txt", "score.csv.old", "station", "sim_server", "flight.log", "flight.json", "uav_agent"}) {
    EXPECT_FALSE(run_folder::is_of_a_run(other)) << other;
  }
}

TEST(RunFolder, CollectedFilesHaveTheNameOfTheirProgram) {
  const std::string agent = programs::agent_program("jurong");
  for (const std::string& own : {run_folder::report_file(agent), run_folder::log_file(agent),
                                 run_folder::map_file("jurong"), run_folder::maps_file("jurong", 1)}) {
    EXPECT_EQ(run_folder::collected_file(agent, own), own);
  }
  for (const std::string& other : {std::string("notes.txt"), run_folder::map_file("changi")}) {
    EXPECT_EQ(run_folder::collected_file(agent, other), "uav_agent-jurong." + other);
  }
}

TEST(RunFolder, KnowsTheUavWhoseMapsAreInAFile) {
  for (int life : {0, 1, 11}) {
    EXPECT_TRUE(run_folder::is_maps_file(run_folder::maps_file("jurong", life), "jurong"));
    EXPECT_FALSE(run_folder::is_maps_file(run_folder::maps_file("jurong", life), "juro"));
  }
  for (const char* other : {"maps-jurong.x.mcap", "maps-jurong..mcap", "maps-jurong.mcap.tmp1", "map-jurong.bt"}) {
    EXPECT_FALSE(run_folder::is_maps_file(other, "jurong")) << other;
  }
}

}  // namespace
}  // namespace skein
