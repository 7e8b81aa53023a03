// losses.csv and its sums from the files of a run, and from files that are missing or do not fit.
#include "results/losses.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "results/testing/scratch.hpp"

namespace skein::results {
namespace {

/// Five points: one delivered, one lost, one never seen, one out of reach, one that scored though it is not attainable.
class RunLosses : public ::testing::Test {
 protected:
  RunLosses() {
    write_text(dir_.path() / "scene.json",
               R"({"points": [[0, 1, 2, 1, 0, 0], [1, 1, 2, 1, 0, 0], [2, 1, 2, 1, 0, 0], [3, 1, 2, 1, 0, 0],
                              [4, 1.5, 2, 1, 0, 0]]})");
    write_text(dir_.path() / "captures.csv",
               "uav,capture,tick,time_s,point,q_seen,q_blur,q_res,q_distance,q,delivered_at_s,reason\n"
               "alpha,0,40,0.1,0,1,1,0.5,0.75,0.5,0.2,\n"
               "beta,3,40,0.1,1,1,0.5,1,1,0.5,,not received\n"
               "alpha,1,80,0.2,4,1,1,0.25,0.25,0.25,0.3,\n");
    answer_ = {{"estimate", {1.0, 0.75, 1.0, 0.5, 0.0}}, {"flyable", "11100"}};
    reports_.sim_server = SimServerReport{.points_seen = "11001"};
    reports_.station = StationReport{.points = {{{.index = 0, .score = 0.5}, {.index = 4, .score = 0.25}}}};
  }
  Json losses() const { return write_losses(dir_.path(), answer_, reports_); }

  Scratch dir_;
  Json answer_;
  Reports reports_;
};

TEST_F(RunLosses, TheTableHasALineForEachPoint) {
  const Json losses = this->losses();
  EXPECT_EQ(losses["tilt"], (Json{{"points", 1}, {"score", 0.5}}));
  EXPECT_EQ(losses["not_delivered"], (Json{{"points", 1}, {"score", 0.75}}));
  EXPECT_EQ(losses["never_in_picture"], (Json{{"points", 1}, {"score", 1.0}}));
  EXPECT_EQ(losses["out_of_reach"], (Json{{"points", 1}, {"score", 0.5}}));
  EXPECT_EQ(losses["above_estimate"], (Json{{"points", 1}, {"score", -0.25}}));
  EXPECT_EQ(losses.size(), 12u);
  double sum = 0.0;
  for (const Json& part : losses) sum += part["score"].get<double>();
  EXPECT_EQ(sum, 3.25 - 0.75);
  EXPECT_EQ(read_text(dir_.path() / "losses.csv"),
            "index,x,y,z,estimate,score,cause,loss,uav,capture,q_distance,q_tilt,q_blur,q,part\n"
            "0,0,1,2,1.0,0.5,tilt,0.5,alpha,0,0.75,0.6666666666666666,1.0,0.5,\n"
            "1,1,1,2,0.75,0.0,not_delivered,0.75,beta,3,1.0,1.0,0.5,0.5,\n"
            "2,2,1,2,1.0,0.0,never_in_picture,1.0,,,,,,,\n"
            "3,3,1,2,0.5,0.0,out_of_reach,0.5,,,,,,,\n"
            "4,4,1.5,2,0.0,0.25,above_estimate,-0.25,alpha,1,0.25,1.0,1.0,0.25,\n");
}

TEST_F(RunLosses, ADamagedPlaceInTheSceneIsLeftEmpty) {
  write_text(dir_.path() / "scene.json", R"({"points": [5, {"x": 1}, null, "x", [4]]})");
  EXPECT_EQ(losses()["tilt"], (Json{{"points", 1}, {"score", 0.5}}));
  const std::string csv = read_text(dir_.path() / "losses.csv");
  for (const char* line : {"\n0,,,,1.0,", "\n1,,,,0.75,", "\n2,,,,1.0,", "\n3,,,,0.5,", "\n4,4,,,0.0,"}) {
    EXPECT_NE(csv.find(line), std::string::npos) << csv;
  }
}

/// The losses as the parts of `below_threshold` by key: points and score.
std::map<std::string, std::pair<std::size_t, double>> parts_of(const Json& losses) {
  std::map<std::string, std::pair<std::size_t, double>> parts;
  const auto sums = poor_parts(losses);
  for (std::size_t i = 0; i < sums.size(); ++i) parts[kPoorParts[i].key] = {sums[i].points, sums[i].score};
  return parts;
}

TEST_F(RunLosses, PointsTooPoorToCountAreSplitByTheBestPicture) {
  answer_ = {{"estimate", {1.0, 0.75, 1.0, 0.5, 0.25}}, {"flyable", "11111"}};
  reports_.sim_server->points_seen = "11111";
  reports_.sim_server->points_poor = std::vector<PoorPointReport>{
      {.index = 2, .q = 0.125, .q_blur = 0.25, .q_distance = 1.0, .q_res = 0.5},
      {.index = 7, .q = 0.125, .q_blur = 0.25, .q_distance = 1.0, .q_res = 0.5},   // the run has no such point
      {.index = 3, .q = 0.125, .q_blur = 0.25, .q_distance = {}, .q_res = 0.5},    // a damaged entry
      {.index = 0, .q = 0.125, .q_blur = 0.25, .q_distance = 1.0, .q_res = 0.5}};  // this point scored
  const Json losses = this->losses();
  const Json nothing = {{"points", 0}, {"score", 0.0}}, blur = {{"points", 1}, {"score", 1.0}},
             unsplit = {{"points", 1}, {"score", 0.5}};
  EXPECT_EQ(losses["below_threshold"],
            (Json{{"points", 2},
                  {"score", 1.5},
                  {"by_part", {{"distance", nothing}, {"tilt", nothing}, {"blur", blur}, {"unsplit", unsplit}}}}));
  const std::string csv = read_text(dir_.path() / "losses.csv");
  EXPECT_NE(csv.find("\n2,2,1,2,1.0,0.0,below_threshold,1.0,,,1.0,0.5,0.25,0.125,blur\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n3,3,1,2,0.5,0.0,below_threshold,0.5,,,,,,,unsplit\n"), std::string::npos) << csv;
  const std::map<std::string, std::pair<std::size_t, double>> expected = {
      {"distance", {0, 0.0}}, {"tilt", {0, 0.0}}, {"blur", {1, 1.0}}, {"unsplit", {1, 0.5}}};
  EXPECT_EQ(parts_of(losses), expected);
}

TEST_F(RunLosses, ReportsAndResultsOfEarlierVersionsAreNotSplit) {
  reports_.sim_server->points_seen = "11111";
  Json losses = this->losses();
  const std::map<std::string, std::pair<std::size_t, double>> expected = {
      {"distance", {0, 0.0}}, {"tilt", {0, 0.0}}, {"blur", {0, 0.0}}, {"unsplit", {1, 1.0}}};
  EXPECT_EQ(parts_of(losses), expected);
  losses["below_threshold"].erase("by_part");
  EXPECT_EQ(parts_of(losses), expected);
  for (const Json& without : {Json(), Json::object()})
    EXPECT_EQ(parts_of(without).at("unsplit"), (std::pair<std::size_t, double>{0, 0.0}));
}

TEST_F(RunLosses, WithoutAMatchingEstimateThereAreNoLosses) {
  const Json answer = answer_;
  const Reports reports = reports_;
  const auto expect_nothing = [&](const char* what) {
    EXPECT_TRUE(losses().is_null()) << what;
    EXPECT_FALSE(std::filesystem::exists(dir_.path() / "losses.csv")) << what;
    answer_ = answer;
    reports_ = reports;
  };
  for (const Json& wrong :
       {Json(), Json::object(), Json{{"estimate", "x"}}, Json{{"estimate", {1.0}}, {"flyable", "1"}}}) {
    answer_ = wrong;
    expect_nothing("answer");
  }
  answer_["estimate"][2] = nullptr;
  expect_nothing("a hole");
  reports_.station.reset();
  expect_nothing("station");
  reports_.station->points->front().index = 5;
  expect_nothing("index");
  reports_.sim_server->points_seen = "1";
  expect_nothing("points seen");
  write_text(dir_.path() / "captures.csv", "uav,capture\nalpha,0\n");
  EXPECT_THROW(losses(), std::runtime_error);
  std::filesystem::remove(dir_.path() / "scene.json");
  expect_nothing("scene");
}

}  // namespace
}  // namespace skein::results
