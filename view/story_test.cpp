#include "view/story.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein::view {
namespace {

TEST(StoryLines, AreJsonWhateverNamesHold) {
  const Json line = parse_json(event_line(1.25, "joined", "a\"b\n\xff", ""));
  EXPECT_EQ(line["k"], "event");
  EXPECT_EQ(line["t"], 1.25);
  EXPECT_EQ(line["e"], "joined");
  EXPECT_TRUE(line["s"].get<std::string>().starts_with("a\"b\n"));
}

TEST(StoryLines, TellWhereCamerasLook) {
  ShownUav uav;
  uav.body.p_WB = {1.0, -2.0, 3.005};
  uav.body.q_WB = Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitZ()));
  uav.gimbal.yaw = 0.25;
  uav.gimbal.pitch = 0.125;
  ShownUav dead;
  dead.alive = false;
  const Json line = parse_json(pose_line(2.0, std::vector{uav, dead}));
  EXPECT_EQ(line["u"][0], Json::array({100, -200, 301, 750, 125, 1}));
  EXPECT_EQ(line["u"][1][5], 0);
}

TEST(StoryLines, SurviveAMotionThatNoNumberDescribes) {
  ShownUav uav;
  uav.body.p_WB = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  uav.body.q_WB.coeffs().setConstant(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(parse_json(pose_line(0.0, std::vector{uav})).is_object());
  uav.body.p_WB = Vector3d::Constant(1e300);
  EXPECT_TRUE(parse_json(pose_line(0.0, std::vector{uav})).is_object());
}

TEST(StoryLines, HaveTheScoreWithAllItsDigits) {
  const double score = 14.067681729793549;
  EXPECT_EQ(parse_json(score_line(1.0, 33, score))["s"].get<double>(), score);
}

TEST(StoryLines, TellCapturesAndLinks) {
  const Json capture = parse_json(capture_line(1.0, 2, 7, {{5, 0.5F, 0.25F, 0.125F, 0.75F}}));
  EXPECT_EQ(capture["u"], 2);
  EXPECT_EQ(capture["c"], 7);
  EXPECT_EQ(capture["p"], Json::parse("[[5,0.125,0.5,0.25,0.75]]"));
  using enum ShownLink;
  EXPECT_EQ(parse_json(links_line(1.0, std::vector{blocked, linked, cut, dead}))["l"], "0123");
  EXPECT_EQ(parse_json(delivered_line(3.5, 2, 7)), Json::parse(R"({"k":"delivered","t":3.5,"u":2,"c":7})"));
  EXPECT_EQ(parse_json(void_line(3.5, 2)), Json::parse(R"({"k":"void","t":3.5,"u":2})"));
}

}  // namespace
}  // namespace skein::view
