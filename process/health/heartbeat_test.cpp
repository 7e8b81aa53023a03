#include "process/health/heartbeat.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <vector>

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
  std::vector<int> touched_ms;
  for (int ms = 0; ms < 5000; ms += 10) {
    heart.beat(Heartbeat::Clock::time_point(std::chrono::hours(1) + std::chrono::milliseconds(ms)));
    if (fs::remove(file)) touched_ms.push_back(ms);
  }
  EXPECT_EQ(touched_ms, (std::vector<int>{0, 2000, 4000}));
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
