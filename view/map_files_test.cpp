// Reads the map files of a run, also those of a program that was restarted, and files that are cut off or damaged.
#include "view/map_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "recording/mcap/writer.hpp"
#include "results/run_folder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;

/// The octree of a map with cells of 0.5 m that knows one cube only: its edge is 16 m, one of its corners is the
/// origin, and all of it is occupied, or all of it is free.
std::string one_large_cube(bool occupied) {
  std::string tree;
  for (int depth = 0; depth < 10; ++depth) tree += std::string(depth == 0 ? "\x00\xC0" : "\x03\x00", 2);
  return tree + std::string(occupied ? "\x02\x00" : "\x01\x00", 2);
}

class MapFilesTest : public testing::Test {
 protected:
  fs::path file(int life = 0) const { return folder_ / run_folder::maps_file("a", life); }
  struct Kept {
    int second;
    bool occupied;
  };
  void keep(const std::vector<Kept>& maps, int life = 0, double cell_m = 0.5) const {
    mcap::Writer writer(file(life));
    const std::uint16_t channel = writer.add_channel("/a/flight_map", "octomap_msgs/msg/Octomap", "");
    for (const auto& [second, occupied] : maps) {
      msg::Octomap message;
      message.header(to_header(second * kTicksPerSecond));
      message.binary(true);
      message.resolution(cell_m);
      const std::string tree = one_large_cube(occupied);
      message.data().assign(tree.begin(), tree.end());
      writer.write(channel, static_cast<std::uint64_t>(second) * 1'000'000'000, encode(message));
      writer.flush();
    }
  }
  /// Reads the maps of a UAV that climbs at 1 m/s: its height in metres is the time in seconds.
  std::optional<MapInTime> read() const {
    return read_maps(folder_, "a", [](double time_s) { return time_s; });
  }
  bool there() const { return has_maps_in_time(folder_, std::vector<std::string>{"a", "b"}); }
  void rewrite(const std::function<void(std::string&)>& change) const {
    std::ostringstream before;
    before << std::ifstream(file()).rdbuf();
    std::string text = before.str();
    change(text);
    std::ofstream(file()) << text;
  }

  const ScratchFolder scratch_;
  const fs::path& folder_ = scratch_.path();
};

TEST_F(MapFilesTest, CubesHaveTimesOfAppearanceAndDisappearance) {
  EXPECT_FALSE(read());
  EXPECT_FALSE(there());
  keep({{2, true}, {5, false}, {7, true}});
  EXPECT_TRUE(there());
  const auto map = read();
  ASSERT_TRUE(map);
  EXPECT_EQ(map->times_s, (std::vector<double>{2.0, 5.0, 7.0}));
  EXPECT_EQ(map->cell_m, 0.5);
  ASSERT_EQ(map->occupied.size(), 2U);
  EXPECT_EQ(map->occupied[0].time_s, 2.0);
  EXPECT_EQ(map->occupied[0].until_s, 5.0);
  EXPECT_EQ(map->occupied[0].runs.size(), 32U * 32U);
  EXPECT_EQ(map->occupied[1].time_s, 7.0);
  EXPECT_EQ(map->occupied[1].until_s, std::nullopt);
  ASSERT_EQ(map->free.size(), 1U);
  EXPECT_EQ(map->free[0].time_s, 5.0);
  EXPECT_EQ(map->free[0].until_s, 7.0);
  EXPECT_EQ(map->free[0].runs[0].z, 10) << "the slice at 5 m, the height of the UAV at 5 s";
}

TEST_F(MapFilesTest, MapsAfterARestartFollowThoseBeforeIt) {
  keep({{2, true}, {5, true}});
  keep({{9, false}}, 1);
  keep({{3, true}}, 3);  // ignored: there is no file of life 2 before it
  const auto map = read();
  ASSERT_TRUE(map);
  EXPECT_EQ(map->times_s, (std::vector<double>{2.0, 5.0, 9.0}));
  ASSERT_EQ(map->occupied.size(), 1U);
  EXPECT_EQ(map->occupied[0].until_s, 9.0) << "after its restart, the program no longer knew the cube";
}

TEST_F(MapFilesTest, ACutOffFileGivesItsCompleteMaps) {
  keep({{2, true}, {5, false}, {7, true}});
  const auto size = fs::file_size(file());
  std::size_t most = 4;
  for (auto left = size; left > size / 4; left -= 40) {
    fs::resize_file(file(), left);
    const auto map = read();
    const std::size_t maps = map ? map->times_s.size() : 0;
    EXPECT_LE(maps, most);
    most = maps;
  }
  EXPECT_LT(most, 3U);
  keep({{2, true}, {5, false}, {7, true}});
  fs::resize_file(file(), size / 2);
  EXPECT_TRUE(there());
}

TEST_F(MapFilesTest, ADamagedFileCountsAsMissing) {
  keep({{2, true}, {5, false}});
  rewrite([](std::string& text) { text[text.size() / 3] ^= 0x20; });
  EXPECT_FALSE(read());
  EXPECT_FALSE(there());
  std::ofstream(file()) << "no such file";
  EXPECT_FALSE(read());
  EXPECT_FALSE(there());
  keep({{5, true}, {2, true}});
  EXPECT_FALSE(read()) << "time goes back";
  keep({{5, true}}, 0, 0.0);
  EXPECT_FALSE(read()) << "cells of no size";
}

TEST_F(MapFilesTest, OfVeryManyMapsOnlySomeAreRead) {
  std::vector<Kept> maps;
  for (int second = 1; second <= 700; ++second) maps.push_back({second, second > 300});
  keep(maps);
  const auto map = read();
  ASSERT_TRUE(map);
  EXPECT_LE(map->times_s.size(), kMostMapsRead);
  EXPECT_GT(map->times_s.size(), kMostMapsRead / 2);
  EXPECT_EQ(map->times_s.back(), 700.0);
  EXPECT_LE(map->times_s.front(), 3.0);
  ASSERT_EQ(map->occupied.size(), 1U);
  EXPECT_NEAR(map->occupied[0].time_s, 301.0, 2.0);
}

}  // namespace
}  // namespace skein::view
