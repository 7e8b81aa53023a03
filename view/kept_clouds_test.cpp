#include "view/kept_clouds.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "process/json_text.hpp"
#include "recording/mcap/writer.hpp"
#include "results/run_folder.hpp"
#include "tests/support/scratch_folder.hpp"
#include "view/testing/unpacked.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;

class KeptCloudsTest : public testing::Test {
 protected:
  void SetUp() override {
    run_.uavs = {"a", "b"};
    run_.explorer = {true, false};
    run_.end_s = 9.0;
    run_.maps = {"", ""};
  }

  fs::path recording() const { return folder_ / "recording.mcap"; }
  /// Records scans at intervals of 0.1 s. Each sees one more piece of a wall.
  void record(const std::string& topic, int scans) const {
    mcap::Writer file(recording());
    const std::uint16_t channel = file.add_channel(topic, "sensor_msgs/msg/PointCloud2", "");
    for (int scan = 0; scan < scans; ++scan) {
      std::vector<Eigen::Vector3f> points;
      for (int x = 0; x <= scan; ++x) points.emplace_back(static_cast<float>(x) + 0.25F, 3.25F, 5.25F);
      const Tick tick = scan * kTicksPerSecond / 10;
      file.write(channel, static_cast<std::uint64_t>(scan) * 100'000'000, encode(to_cloud(tick, points)));
    }
  }
  /// Writes an empty map to the file with the UAV's maps in time.
  void keep_empty_map(const std::string& uav, int second) const {
    mcap::Writer file(folder_ / run_folder::maps_file(uav, 0));
    const std::uint16_t channel = file.add_channel("/" + uav + "/flight_map", "octomap_msgs/msg/Octomap", "");
    msg::Octomap map;
    map.header(to_header(second * kTicksPerSecond));
    map.resolution(0.5);
    file.write(channel, static_cast<std::uint64_t>(second) * 1'000'000'000, encode(map));
  }
  static Json told(const Feed& feed, const std::string& name) {
    FeedPlace place;
    place.look_at({name});
    const Json message = parse_json(feed.next(place, 1 << 20));
    return message.contains("clouds") ? message["clouds"][0] : Json();
  }
  static void begin(Feed& feed) { feed.set_scene("{}"); }

  const ScratchFolder scratch_;
  const fs::path& folder_ = scratch_.path();
  results::RunRecord run_;
};

TEST_F(KeptCloudsTest, EachPointIsSentOnceAtItsTime) {
  record("/a/cloud_inW", 30);
  const KeptClouds clouds(folder_, run_);
  EXPECT_EQ(clouds.lidar, std::vector<std::string>{"a"});
  EXPECT_TRUE(clouds.maps.empty());
  EXPECT_EQ(clouds.missing, "");
  Feed feed;
  begin(feed);
  clouds.tell({}, feed);
  const Json cloud = told(feed, "lidar a");
  double last_s = -1.0;
  int seen = 0;
  for (const Json& step : cloud["steps"]) {
    const double time_s = step["t"].get<double>();
    EXPECT_GT(time_s, last_s);
    last_s = time_s;
    for (const Vector3d& p_W : unpacked_points(step["points"].get<std::string>())) {
      EXPECT_NEAR(p_W.x(), seen + 0.25, 0.06);
      EXPECT_LE(0.1 * seen, time_s + 1e-9) << "a scan must have seen the point by then";
      ++seen;
    }
  }
  EXPECT_EQ(seen, 30);
  EXPECT_NEAR(last_s, 2.9, 1e-9);
  EXPECT_TRUE(told(feed, "lidar b").is_null());
}

TEST_F(KeptCloudsTest, NameTheMissingData) {
  EXPECT_NE(KeptClouds(folder_, run_).missing.find("--record=clouds"), std::string::npos) << "there is no recording";
  record("/a/gimbal", 3);
  EXPECT_NE(KeptClouds(folder_, run_).missing.find("--record=clouds"), std::string::npos)
      << "the recording has no clouds";
  std::ofstream(recording()) << "no recording at all";
  EXPECT_NE(KeptClouds(folder_, run_).missing.find("--record=clouds"), std::string::npos);
  run_.explorer = {false, false};
  EXPECT_EQ(KeptClouds(folder_, run_).missing, "") << "no UAV has a LiDAR";
}

TEST_F(KeptCloudsTest, MapsAreThoseInTheResultsFolder) {
  // A cube of 16 m at the origin is occupied, and the next one along x is free.
  std::string tree;
  for (int depth = 0; depth < 10; ++depth) tree += std::string(depth == 0 ? "\x00\xC0" : "\x03\x00", 2);
  tree += std::string("\x06\x00", 2);
  run_.maps[1] = "# Octomap OcTree binary file\n#\nid OcTree\nsize 13\nres 0.5\ndata\n" + tree;
  const KeptClouds clouds(folder_, run_);
  EXPECT_EQ(clouds.maps, std::vector<std::string>{"b"});
  Feed feed;
  begin(feed);
  std::vector<ShownUav> fleet(2);
  fleet[1].body.p_WB.z() = 3.0;
  clouds.tell(fleet, feed);
  const Json map = told(feed, "map b");
  ASSERT_TRUE(map.is_object());
  EXPECT_EQ(map["t"], 9.0);
  EXPECT_EQ(map["z"], 3.0);
  EXPECT_NE(map["kind"].get<std::string>().find("key frames"), std::string::npos);
  const auto runs = unpacked_runs(map["steps"][0]["runs"].get<std::string>());
  const auto free = unpacked_runs(map["free"].get<std::string>());
  EXPECT_EQ(runs.size(), 32U * 32U);
  EXPECT_EQ(runs[0], (CubeRun{0, 0, 0, 32}));
  EXPECT_EQ(free.size(), 32U);
  EXPECT_EQ(free[0], (CubeRun{32, 0, 6, 32}));
  EXPECT_TRUE(told(feed, "map a").is_null());
  EXPECT_NE(clouds.missing.find("cannot be computed"), std::string::npos) << "there is no recording";
  record("/a/cloud_inW", 3);
  EXPECT_NE(KeptClouds(folder_, run_).missing.find("skein replay RUN --maps"), std::string::npos);
}

TEST_F(KeptCloudsTest, MapsInTimeTakePrecedenceOverThoseOfTheEnd) {
  keep_empty_map("a", 3);
  keep_empty_map("b", 5);
  std::ofstream(folder_ / run_folder::maps_file("b", 1)) << "damaged";
  run_.maps = {"x", ""};
  const KeptClouds clouds(folder_, run_);
  EXPECT_EQ(clouds.maps, std::vector<std::string>{"a"});
  EXPECT_EQ(clouds.missing.find("--maps"), std::string::npos) << clouds.missing;
  Feed feed;
  begin(feed);
  clouds.tell(std::vector<ShownUav>(2), feed);
  const Json map = told(feed, "map a");
  ASSERT_TRUE(map.is_object());
  EXPECT_EQ(map["kind"], "what it flies on");
  EXPECT_EQ(map["times"], Json::parse("[3.0]"));
  EXPECT_TRUE(told(feed, "map b").is_null());
}

}  // namespace
}  // namespace skein::view
