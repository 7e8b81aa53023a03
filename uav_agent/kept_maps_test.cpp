// Snapshots of maps: what the file contains, and when. The same calls write the same bytes.
#include "uav_agent/kept_maps.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "recording/mcap/reader.hpp"
#include "results/run_folder.hpp"
#include "tests/support/scratch_folder.hpp"
#include "uav_agent/testing/news_radio.hpp"

namespace skein::agent {
namespace {

namespace fs = std::filesystem;

constexpr Tick kSecond = kTicksPerSecond;

class KeptMapsTest : public testing::Test {
 protected:
  struct Snapshot {
    Tick tick = 0;
    std::vector<std::uint8_t> bytes;
    bool operator==(const Snapshot&) const = default;
  };
  std::vector<Snapshot> snapshots(int life, bool complete) const {
    std::vector<Snapshot> found;
    mcap::Reader reader(folder_ / run_folder::maps_file("a", life));
    EXPECT_EQ(reader.complete(), complete);
    EXPECT_TRUE(reader.damage().empty());
    reader.messages([&](const mcap::Channel& channel, const mcap::Message& message) {
      EXPECT_EQ(channel.topic, "/a/flight_map");
      EXPECT_EQ(reader.schemas().at(channel.schema_id).name, "octomap_msgs/msg/Octomap");
      msg::Octomap map;
      ASSERT_TRUE(decode(message.data, map));
      const Tick tick = from_time(map.header().stamp());
      EXPECT_EQ(message.log_time, static_cast<std::uint64_t>(tick) * (1'000'000'000 / kTicksPerSecond));
      found.push_back({tick, {map.data().begin(), map.data().end()}});
    });
    return found;
  }
  std::string text_of_file(int life) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / run_folder::maps_file("a", life)).rdbuf();
    return text.str();
  }
  /// 60 s in which the map grows in the seconds 0 to 24, 26 and 55. @returns the map after every ten seconds.
  std::vector<Snapshot> fly(KeptMaps& kept) {
    RandomStream random(7, "kept_maps", 0);
    WorldMap map(WorldMap::Config{});
    std::vector<Snapshot> expected;
    for (Tick tick = 0; tick <= 60 * kSecond; tick += kSecond / 20) {
      const Tick second = tick / kSecond;
      const bool grows = tick % kSecond == 0 && (second <= 24 || second == 26 || second == 55);
      if (grows) test::draw_space(map, random, {0.0, 0.0, 10.0}, 20.0, 5);
      kept.keep(tick, &map, none_);
      MapTree tree;
      tree.update(map);
      if (tick % (10 * kSecond) == 0) expected.push_back({tick, tree.bytes()});
    }
    kept.end(&map, none_);
    return expected;
  }

  const ScratchFolder scratch_;
  const fs::path& folder_ = scratch_.path();
  const OccupancyMap none_;
};

TEST_F(KeptMapsTest, SnapshotsAreWrittenWhenTheMapHasChangedAndAtTheEnd) {
  KeptMaps kept(folder_, "a", 10 * kSecond);
  std::vector<Snapshot> expected = fly(kept);
  ASSERT_EQ(expected.size(), 7U);
  expected.erase(expected.begin() + 4, expected.begin() + 6);  // of 40 s and 50 s: nothing had changed since 30 s
  EXPECT_EQ(snapshots(0, true), expected);
  EXPECT_EQ(kept.write_error(), "");
  EXPECT_FALSE(fs::exists(folder_ / run_folder::maps_file("a", 1)));
}

TEST_F(KeptMapsTest, EqualFlightsGiveFilesWithEqualBytes) {
  for (int life = 0; life < 2; ++life) {
    KeptMaps kept(folder_, "a", 10 * kSecond);
    fly(kept);
  }
  EXPECT_EQ(text_of_file(0), text_of_file(1));
  EXPECT_GT(text_of_file(0).size(), 1000U);
}

TEST_F(KeptMapsTest, EachSnapshotIsInTheFileBeforeTheFileIsClosed) {
  WorldMap map(WorldMap::Config{});
  RandomStream random(9, "kept_maps", 0);
  KeptMaps kept(folder_, "a", kSecond);
  for (std::size_t i = 1; i <= 3; ++i) {
    test::draw_space(map, random, {0.0, 0.0, 10.0}, 20.0, 5);
    kept.keep(static_cast<Tick>(i) * kSecond, &map, none_);
    EXPECT_EQ(snapshots(0, false).size(), i);  // it has not been closed
  }
}

TEST_F(KeptMapsTest, SnapshotsShowTheMapOfKeyFramesIfTheUavFliesByIt) {
  OccupancyMap map;
  KeptMaps kept(folder_, "a", kSecond);
  for (int step = 0; step <= 5; ++step) {
    if (step == 1 || step == 4) map.insert({Eigen::Vector3f(3.0F, static_cast<float>(step), 5.0F)}, std::nullopt);
    kept.keep(step * kSecond, nullptr, map);
  }
  kept.end(nullptr, map);
  const std::vector<Snapshot> found = snapshots(0, true);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].tick, kSecond);
  EXPECT_EQ(found[1].tick, 4 * kSecond);
  EXPECT_EQ(found[2].tick, 5 * kSecond) << "the snapshot of the end";
  EXPECT_NE(found[0].bytes, found[1].bytes);
  EXPECT_EQ(found[1].bytes, found[2].bytes);
}

TEST_F(KeptMapsTest, AUavThatNeverTookAStepLeavesNoFile) {
  KeptMaps kept(folder_, "a", kSecond);
  kept.end(nullptr, none_);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(KeptMapsTest, SnapshotsEndWithAnErrorThatNamesTheFileIfItCannotBeWritten) {
  KeptMaps nowhere(folder_ / "none", "a", kSecond);
  fly(nowhere);
  EXPECT_NE(nowhere.write_error().find("maps-a.mcap"), std::string::npos) << nowhere.write_error();

  fs::create_symlink("loop", folder_ / "loop");  // exists() throws, for root too
  KeptMaps unsearchable(folder_ / "loop", "a", kSecond);
  fly(unsearchable);
  EXPECT_NE(unsearchable.write_error().find("maps-a.mcap"), std::string::npos) << unsearchable.write_error();

  rlimit former{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &former), 0);
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  const rlimit low{6000, former.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &low), 0);
  KeptMaps kept(folder_, "a", kSecond);
  fly(kept);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &former), 0);
  ::signal(SIGXFSZ, handler);
  EXPECT_NE(kept.write_error().find("maps-a.mcap"), std::string::npos) << kept.write_error();
  EXPECT_LE(fs::file_size(folder_ / "maps-a.mcap"), 6000U);
  EXPECT_FALSE(snapshots(0, false).empty()) << "the file has the snapshots for which there was room";
}

}  // namespace
}  // namespace skein::agent
