#include "view/finished_run.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "core/types.hpp"
#include "process/json_text.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;

class FinishedRun : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path() / "skein-view-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    write("result.json", R"({"scenario": "towers", "status": "completed", "score": 0.8765432101234567,
      "points_detected": 1, "sim_time_s": 3.0, "exchange_period_s": 0.05, "planners": {"a": "kios", "b": "hover"},
      "uavs": [{"name": "a", "role": "explorer"}, {"name": "b", "role": "photographer"}],
      "station": {"position": [1, 2, 0]}, "collisions": [{"time_s": 2.5, "uav": "b", "with": "structure"}]})");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  void write_tables() const {
    write("scene.json", R"({"boxes": []})");
    write("score.csv", "index,x,y,z,nx,ny,nz,score\n0,1,2,3,0,0,1,0.877\n1,1,2,4,0,0,1,0\n");
    std::string poses = "time_s,uav,x,y,z,qw,qx,qy,qz,vx,vy,vz,gimbal_pitch,gimbal_yaw,alive,clearance\n";
    for (int i = 0; i <= 30; ++i) {
      const std::string time = std::to_string(0.1 * i);
      poses += time + ",a," + time + ",0,1,1,0,0,0,1,0,0,0,0,1,5\n" + time + ",b,0,0,2,1,0,0,0,0,0,0,0,0,1,5\n";
    }
    write("trajectories.csv", poses);
    write("events.csv",
          "step,time_s,event,subject,object\n0,0.00,joined,a,\n1,0.05,link_up,a,gcs\n1,0.05,link_up,gcs,a\n"
          "20,1.00,link_down,a,gcs\n20,1.00,captured,a,0\n30,1.50,released,a,0\n");
    write("captures.csv",
          "uav,capture,tick,time_s,point,q_seen,q_blur,q_res,q_distance,q,delivered_at_s,reason\n"
          "a,0,400,1.00,0,1,0.9,0.974,0.99,0.877,1.20,\na,0,400,1.00,1,1,0.5,0.5,0.9,0.25,1.20,better capture\n"
          "b,0,800,2.00,1,1,0.9,0.9,0.9,0.81,,uav collided\n");
    write("score_timeline.csv", "time_s,points,score\n0.00,0,0\n1.20,1,0.877\n");
  }

  /// Of a kind.
  std::vector<Json> lines(const std::string& kind) const {
    std::vector<Json> found;
    for (const Json& line : told_["lines"]) {
      if (line["k"] == kind) found.push_back(line);
    }
    return found;
  }
  void tell() {
    Feed feed;
    tell_finished_run(folder_, feed);
    FeedPlace place;
    told_ = parse_json(feed.next(place, 1 << 20));
    ASSERT_TRUE(told_.is_object());
  }

  fs::path folder_;
  Json told_;
};

TEST_F(FinishedRun, IsToldInTheOrderOfItsTime) {
  write_tables();
  tell();
  double last_s = 0.0;
  for (const Json& line : told_["lines"]) {
    EXPECT_LE(last_s, line["t"].get<double>()) << line;
    last_s = line["t"].get<double>();
  }
  EXPECT_EQ(told_["scene"]["mode"], "replay");
  EXPECT_EQ(told_["scene"]["uavs"][1]["name"], "b");
  EXPECT_EQ(told_["scene"]["points"].size(), 2U * 9U);
  EXPECT_EQ(told_["scene"]["station"], Json::array({100, 200, 0}));
}

TEST_F(FinishedRun, HasTrailsLinksAndCaptures) {
  write_tables();
  tell();
  const auto poses = lines("pose");
  EXPECT_EQ(poses.size(), 7U) << "from 0 to 3 s, one in half a second";
  EXPECT_EQ(poses[2]["u"][0][0], 100);
  const auto links = lines("links");
  ASSERT_EQ(links.size(), 2U) << "one a step in which any changes";
  EXPECT_EQ(links[0]["l"], "010100000");
  EXPECT_EQ(links[1]["l"], "010000000");
  const auto captures = lines("capture");
  ASSERT_EQ(captures.size(), 2U);
  EXPECT_EQ(captures[0]["p"].size(), 2U);
  EXPECT_EQ(lines("delivered").size(), 1U) << "the other never was";
  ASSERT_EQ(lines("void").size(), 1U);
  EXPECT_EQ(lines("void")[0]["u"], 1);
}

TEST_F(FinishedRun, EndsWithTheScoreOfItsResult) {
  write_tables();
  tell();
  EXPECT_EQ(lines("score").back()["s"].get<double>(), 0.8765432101234567);
}

TEST_F(FinishedRun, SaysWhatItLacks) {
  tell();
  EXPECT_GE(told_["scene"]["missing"].size(), 4U);
  EXPECT_EQ(lines("pose").size(), 0U);
}

TEST_F(FinishedRun, IsNoneWithoutAResult) {
  fs::remove(folder_ / "result.json");
  Feed feed;
  EXPECT_THROW(tell_finished_run(folder_, feed), InputError);
  EXPECT_THROW(title_of_run(folder_), InputError);
}

}  // namespace
}  // namespace skein::view
