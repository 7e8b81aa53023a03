#include "view/finished_run.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"
#include "process/json_text.hpp"
#include "view/testing/results_folder.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;

class FinishedRun : public testing::Test {
 protected:
  /// The lines of this kind that the feed has got.
  std::vector<Json> lines(const std::string& kind) const {
    std::vector<Json> found;
    for (const Json& line : told_["lines"]) {
      if (line["k"] == kind) found.push_back(line);
    }
    return found;
  }
  void tell() {
    Feed feed;
    tell_finished_run(folder_.path(), feed);
    FeedPlace place;
    told_ = parse_json(feed.next(place, 1 << 20));
    ASSERT_TRUE(told_.is_object());
  }

  ResultsFolder folder_;
  Json told_;
};

TEST_F(FinishedRun, IsSentInTheOrderOfTime) {
  folder_.write_tables();
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
  folder_.write_tables();
  tell();
  const auto poses = lines("pose");
  EXPECT_EQ(poses.size(), 7U) << "from 0 to 3 s, each half second has a line";
  EXPECT_EQ(poses[2]["u"][0][0], 100);
  const auto links = lines("links");
  ASSERT_EQ(links.size(), 3U) << "each step in which a link changes has a line";
  EXPECT_EQ(links[0]["l"], "010100000");
  EXPECT_EQ(links[1]["l"], "010000000");
  EXPECT_EQ(links[2]["l"], "013003330") << "b collides";
  const auto captures = lines("capture");
  ASSERT_EQ(captures.size(), 2U);
  EXPECT_EQ(captures[0]["p"].size(), 2U * 4U);
  EXPECT_EQ(lines("delivered").size(), 1U) << "the other capture was never delivered";
  ASSERT_EQ(lines("void").size(), 1U);
  EXPECT_EQ(lines("void")[0]["u"], 1);
}

TEST_F(FinishedRun, HasTheActivitiesOfTheUavs) {
  folder_.write_tables();
  const std::string line =
      R"({"k":"activity","t":1.5,"u":0,"m":"flies to a goal","g":[100,-250,300],"w":"b","n":"no way"})";
  folder_.write("activity.csv",
                "step,time_s,uav,mode,goal_x,goal_y,goal_z,waits_for,no_way\n0,0.00,b,on the ground,,,,,\n"
                "30,1.50,a,flies to a goal,1.00,-2.50,3.00,b,no way\n31,1.55,nobody,flies,,,,,\n31,1.55,a,cut o");
  tell();
  const auto activities = lines("activity");
  ASSERT_EQ(activities.size(), 2U);
  EXPECT_EQ(activities[0]["m"], "on the ground");
  EXPECT_EQ(activities[0]["g"], nullptr);
  EXPECT_EQ(activities[1], Json::parse(line));
  const auto names = [this](const char* text) {
    return told_["scene"]["missing"].dump().find(text) != std::string::npos;
  };
  const auto lacks = [&] { return names("There is no activity.csv"); };
  EXPECT_FALSE(lacks());
  EXPECT_TRUE(names("activity.csv")) << "its last row is cut off";
  fs::remove(folder_.path() / "activity.csv");  // as in a run of an earlier version
  tell();
  EXPECT_EQ(lines("activity").size(), 0U);
  EXPECT_TRUE(lacks());
}

TEST_F(FinishedRun, EndsWithTheScoreOfItsResult) {
  folder_.write_tables();
  tell();
  EXPECT_EQ(lines("score").back()["s"].get<double>(), 0.8765432101234567);
}

TEST_F(FinishedRun, HasTheCamerasOfItsScene) {
  const auto says = [&](const std::string& what) {
    for (const std::string missing : told_["scene"]["missing"]) {
      if (missing.find(what) != std::string::npos) return true;
    }
    return false;
  };
  folder_.write_tables();
  tell();
  EXPECT_EQ(told_["scene"]["uavs"][0]["hfov"], CameraConfig{}.hfov_deg);
  EXPECT_TRUE(says("cameras"));
  folder_.write("scene.json", R"({"boxes": [], "cameras": [{"uav": "b", "hfov_deg": 30, "vfov_deg": 20, "range_m": 7.5},
                              {"uav": "a", "hfov_deg": 40, "vfov_deg": 30, "range_m": 9}]})");
  tell();
  EXPECT_EQ(told_["scene"]["uavs"][0]["hfov"], 40.0);
  EXPECT_EQ(told_["scene"]["uavs"][1]["vfov"], 20.0);
  EXPECT_EQ(told_["scene"]["uavs"][1]["range"], 7.5);
  EXPECT_FALSE(says("cameras"));
  for (const char* damaged : {"0", "180", "-3", "null", "[]"}) {
    folder_.write("scene.json", R"({"cameras": [{"uav": "a", "hfov_deg": )" + std::string(damaged) +
                                    R"(, "vfov_deg": 30, "range_m": 9}]})");
    tell();
    EXPECT_EQ(told_["scene"]["uavs"][0]["hfov"], CameraConfig{}.hfov_deg) << damaged;
  }
}

TEST_F(FinishedRun, NamesTheDataThatItLacks) {
  tell();
  EXPECT_GE(told_["scene"]["missing"].size(), 4U);
  EXPECT_EQ(lines("pose").size(), 0U);
}

TEST_F(FinishedRun, IsRefusedWithoutAResult) {
  fs::remove(folder_.path() / "result.json");
  Feed feed;
  EXPECT_THROW(tell_finished_run(folder_.path(), feed), InputError);
  EXPECT_THROW(title_of_run(folder_.path()), InputError);
}

}  // namespace
}  // namespace skein::view
