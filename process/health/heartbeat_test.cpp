#include "process/health/heartbeat.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace skein {
namespace {

namespace fs = std::filesystem;

class HeartbeatTest : public testing::Test {
 protected:
  HeartbeatTest() {
    std::string pattern = fs::path(testing::TempDir()) / "heartbeat_XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~HeartbeatTest() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(HeartbeatTest, TheFirstBeatCreatesTheFile) {
  const fs::path file = folder_ / "alive";
  Heartbeat heart(file);
  EXPECT_FALSE(fs::exists(file));
  heart.beat();
  EXPECT_TRUE(fs::is_regular_file(file));
}

TEST_F(HeartbeatTest, ABeatUpdatesTheTimeOfAnExistingFileAndKeepsItsText) {
  const fs::path file = folder_ / "alive";
  std::ofstream(file) << "text";
  const auto old = fs::last_write_time(file) - std::chrono::hours(1);
  fs::last_write_time(file, old);
  Heartbeat(file).beat();
  EXPECT_GT(fs::last_write_time(file), old + std::chrono::minutes(30));
  EXPECT_EQ(fs::file_size(file), 4u);
}

// The program calls beat() far more often than every two seconds.
TEST_F(HeartbeatTest, MostBeatsDoNotTouchTheFile) {
  const fs::path file = folder_ / "alive";
  Heartbeat heart(file);
  int touched = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() < end) {
    heart.beat();
    touched += fs::remove(file) ? 1 : 0;
  }
  const auto passed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GE(touched, 1);
  EXPECT_LE(touched, 1 + passed_s / 2.0);
}

TEST_F(HeartbeatTest, AFileThatCannotBeWrittenIsNotAnError) {
  for (const fs::path& file : {fs::path(), folder_ / "none" / "alive", folder_, fs::path("/proc/alive")}) {
    Heartbeat heart(file);
    EXPECT_NO_THROW(heart.beat()) << file;
    EXPECT_FALSE(fs::is_regular_file(file)) << file;
  }
}

}  // namespace
}  // namespace skein
