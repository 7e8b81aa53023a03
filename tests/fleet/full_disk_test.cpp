// A full disk truncates files but never ends the flight: score and result are those of a run with enough space.
#include <cerrno>
#include <random>

#include "fleet_fixture.hpp"
#include "recording/mcap/reader.hpp"
#include "small_disk.hpp"
#include "small_scene.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class FullDisk : public FleetTest {
 protected:
  FullDisk() {
    SmallScene scene = default_scene();
    scene.duration_s = 100.0;
    scenario_ = write_small_scene(folder(), scene);
  }
  Arguments arguments() const { return {scenario_, "--planner", "patrol"}; }
  std::string scenario_;
};

TEST_F(FullDisk, ARunThatFillsTheDiskHasItsFullResult) {
  std::mt19937 draw(1);
  std::vector<std::unique_ptr<SmallDisk>> disks;
  std::vector<SkeinRun*> runs = {&start("with_room", arguments())};
  for (const int most_kb : {500, 700}) {
    const int size_kb = most_kb - static_cast<int>(draw() % 60);
    const std::string name = "of_" + std::to_string(size_kb) + "_kB";
    disks.push_back(std::make_unique<SmallDisk>(folder() / name, size_kb));
    if (!disks.back()->mounted()) GTEST_SKIP() << "a disk can be mounted by root only";
    runs.push_back(&start(name, arguments()));
  }
  for (SkeinRun* run : runs) {
    SCOPED_TRACE(run->dir().filename());
    EXPECT_EQ(run->exit_code(), 0) << run->err();
    expect_complete_result(*run);
    EXPECT_EQ(run->result()["status"], "completed");
    EXPECT_EQ(run->result()["score"], runs[0]->result()["score"]);
    EXPECT_EQ(run->digest(), runs[0]->digest());
    EXPECT_TRUE(run->result()["uavs"][0]["planner_cpu_s"].is_number());
    const std::string warnings = run->result()["warnings"].dump();
    EXPECT_EQ(warnings.find("No space left on device") != std::string::npos, run != runs[0]) << warnings;
    EXPECT_EQ(run->out().find("warning: files are missing or cut short") != std::string::npos, run != runs[0]);
    const std::string digests = text_of(run->dir() / "digests.csv");
    EXPECT_TRUE(digests.empty() || digests.back() == '\n') << "a line is torn";
    for (const auto& entry : fs::directory_iterator(run->dir())) {
      if (entry.path().extension() != ".mcap") continue;
      int messages = 0;
      mcap::Reader(entry.path()).messages([&](const mcap::Channel&, const mcap::Message&) { ++messages; });
      EXPECT_GT(messages, 0) << entry.path();
    }
  }
}

TEST_F(FullDisk, ARunWithoutRoomForItsResultIsNotStarted) {
  const SmallDisk disk(folder() / "tiny", 128);
  if (!disk.mounted()) GTEST_SKIP() << "a disk can be mounted by root only";
  SkeinRun& run = this->run("tiny", arguments(), {}, 2);
  EXPECT_NE(run.err().find("no room for a result"), std::string::npos) << run.err();
  EXPECT_TRUE(fs::is_empty(run.dir()));
}

}  // namespace
}  // namespace skein::test
