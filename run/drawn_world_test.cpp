#include "run/drawn_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

class DrawnWorld : public ::testing::Test {
 protected:
  DrawnWorld() {
    if (const char* previous = std::getenv("XDG_CACHE_HOME")) previous_cache_ = previous;
    ::setenv("XDG_CACHE_HOME", cache().c_str(), 1);
    write_script(programs_.dir() / "sim_server", kDrawWorld);
  }
  ~DrawnWorld() override {
    previous_cache_ ? ::setenv("XDG_CACHE_HOME", previous_cache_->c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
  }

  fs::path cache() const { return programs_.dir() / "cache"; }
  std::size_t drawn() const { return static_cast<std::size_t>(std::ranges::count(read_text(log()), '\n')); }
  fs::path log() const { return programs_.dir() / "drawn.log"; }

  const FakePrograms programs_;

 private:
  std::optional<std::string> previous_cache_;
};

TEST_F(DrawnWorld, IsDrawnOnce) {
  EXPECT_EQ(scenario_source("towers", 3), "towers") << "only wild scenes are drawn";
  const fs::path file = scenario_source("wild", 3);
  EXPECT_EQ(file.filename(), "wild_3.yaml");
  EXPECT_TRUE(fs::is_regular_file(file));
  EXPECT_EQ(scenario_source("wild", 3), file);
  EXPECT_EQ(drawn(), 1U);
  EXPECT_NE(scenario_source("wild", {}), file);
  EXPECT_EQ(drawn(), 2U);
}

TEST_F(DrawnWorld, IsDrawnAgainIfOneOfItsFilesIsMissing) {
  const fs::path file = scenario_source("wild", 3);
  std::size_t draws = 1;
  for (const char* name : {"models/m.stl", "models/p.pcd", "models/b.yaml", "models", "wild_3.yaml"}) {
    fs::remove_all(file.parent_path() / name);
    EXPECT_EQ(scenario_source("wild", 3), file) << name;
    EXPECT_TRUE(fs::exists(file.parent_path() / name)) << name;
    EXPECT_EQ(drawn(), ++draws) << name;
  }
  fs::remove(file.parent_path() / "wild_3.sha256");
  EXPECT_EQ(scenario_source("wild", 3), file);
  EXPECT_EQ(drawn(), ++draws) << "a world that an earlier version of Skein wrote, without a checksum";
  write_text(file, "name: [");
  EXPECT_EQ(scenario_source("wild", 3), file);
  EXPECT_EQ(drawn(), ++draws) << "a damaged scenario";
}

TEST_F(DrawnWorld, IsDrawnAgainIfOneOfItsFilesIsDamaged) {
  const fs::path file = scenario_source("wild", 3);
  std::size_t draws = 1;
  for (const char* name : {"models/m.stl", "models/p.pcd", "models/b.yaml", "wild_3.yaml", "wild_3.sha256"}) {
    const fs::path damaged = file.parent_path() / name;
    const std::string sound = read_text(damaged);
    ASSERT_FALSE(sound.empty());
    std::string flipped = sound;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    for (const std::string& bad : {sound.substr(0, sound.size() - 1), std::string(), flipped}) {
      write_text(damaged, bad);
      EXPECT_EQ(scenario_source("wild", 3), file) << name;
      EXPECT_EQ(read_text(damaged), sound) << name;
      EXPECT_EQ(drawn(), ++draws) << name;
    }
  }
  EXPECT_EQ(scenario_source("wild", 3), file);
  EXPECT_EQ(drawn(), draws) << "an undamaged world is not drawn again";
}

TEST_F(DrawnWorld, WithoutAChecksumIsUsedIfTheCacheIsReadOnly) {
  const fs::path file = scenario_source("wild", 3);
  write_script(programs_.dir() / "sim_server", "echo '--out: cannot be written to'; exit 2");
  EXPECT_EQ(scenario_source("wild", 3), file) << "its checksum matches, so sim_server need not draw it again";
  fs::remove(file.parent_path() / "wild_3.sha256");
  EXPECT_EQ(scenario_source("wild", 3), file);
  write_text(file.parent_path() / "wild_3.sha256", "0\n");
  EXPECT_THROW(scenario_source("wild", 3), InputError)
      << "its checksum does not match, and sim_server cannot draw the world again";
  fs::remove(file.parent_path() / "wild_3.sha256");
  fs::remove(file.parent_path() / "models/m.stl");
  EXPECT_THROW(scenario_source("wild", 3), InputError)
      << "a file is missing, and sim_server cannot draw the world again";
}

}  // namespace
}  // namespace skein::cli
