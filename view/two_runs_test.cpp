#include "view/two_runs.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"
#include "process/json_text.hpp"
#include "view/testing/results_folder.hpp"

namespace skein::view {
namespace {

class TwoRuns : public testing::Test {
 protected:
  TwoRuns() {
    a_.write_tables();
    b_.write_tables();
  }

  Json told(const Parting& parting = {}) const {
    Feed feed;
    tell_two_runs(a_.path(), b_.path(), parting, feed);
    FeedPlace place;
    return parse_json(feed.next(place, 1 << 20));
  }

  ResultsFolder a_, b_;
};

TEST_F(TwoRuns, AreSentAsOneRunThatContainsTheOther) {
  b_.write("score_timeline.csv", "time_s,points,score\n0.00,0,0\n2.00,1,0.5\n");
  const Json both = told({2.0, {"a position"}, {}});
  EXPECT_EQ(both["scene"]["other"]["uavs"].size(), 2U);
  EXPECT_EQ(both["scene"]["difference"]["t"], 2.0);
  EXPECT_EQ(both["scene"]["difference"]["fields"], Json::array({"a position"}));
  EXPECT_EQ(both["scene"]["fleets_differ"], false);
  std::size_t own = 0, others = 0;
  for (const Json& line : both["lines"]) {
    const bool other = line["k"] == "other";
    ++(other ? others : own);
    const Json& shown = other ? line["line"] : line;
    EXPECT_TRUE(shown.contains("t") && shown["k"] != "other") << line;
    if (shown["k"] == "score") {
      EXPECT_EQ(shown["t"] == 2.0, other && shown["s"] == 0.5) << line;
    }
  }
  EXPECT_EQ(own, others);
}

TEST_F(TwoRuns, NameTheReasonIfTheDifferenceIsUnknown) {
  EXPECT_TRUE(told()["scene"]["difference"].empty());
  EXPECT_EQ(told({{}, {}, "no digests.csv"})["scene"]["difference"]["unknown"], "no digests.csv");
}

TEST_F(TwoRuns, MayHaveDifferentFleets) {
  b_.write("result.json", R"({"scenario": "towers", "status": "completed", "sim_time_s": 3.0,
                               "uavs": [{"name": "b", "role": "explorer"}]})");
  EXPECT_EQ(told()["scene"]["fleets_differ"], true);
}

TEST_F(TwoRuns, AreRefusedIfTheirScenesDiffer) {
  b_.write("score.csv", "index,x,y,z,nx,ny,nz,score\n0,1,2,3,0,0,1,0.877\n1,1,2,4.5,0,0,1,0\n");
  EXPECT_THROW(told(), InputError);
  b_.write("score.csv", "index,x,y,z,nx,ny,nz,score\n0,1,2,3,0,0,1,0.877\n");
  EXPECT_THROW(told(), InputError);
}

TEST_F(TwoRuns, AreRefusedWithTheWholeNumbersOfTheirScenes) {
  b_.write("score.csv", "index,x,y,z,nx,ny,nz,score\n0,1,2,3,0,0,1,0.877\n");
  b_.write("result.json", R"({"scenario": "wild", "scene_seed": 18446744073709551615, "status": "completed",
                               "sim_time_s": 3.0, "uavs": [{"name": "b", "role": "explorer"}]})");
  try {
    told();
    ADD_FAILURE() << "two scenes were accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("wild with scene seed 18446744073709551615, 1 points"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace skein::view
