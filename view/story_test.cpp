#include "view/story.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein::view {
namespace {

TEST(StoryLines, AreJsonForAnyNames) {
  const Json line = parse_json(event_line(1.25, "joined", "a\"b\n\xff", ""));
  EXPECT_EQ(line["k"], "event");
  EXPECT_EQ(line["t"], 1.25);
  EXPECT_EQ(line["e"], "joined");
  EXPECT_TRUE(line["s"].get<std::string>().starts_with("a\"b\n"));
}

TEST(StoryLines, HaveTheDirectionsOfCameras) {
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

TEST(StoryLines, AreJsonAlsoIfAMotionIsNotFinite) {
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

TEST(StoryLines, HaveTheActivityOfAUavAndItsReason) {
  const Activity flies{.mode = "flies to a \"goal\"", .goal_W = Vector3d(1.0, -2.0, 3.005), .waits_for = "changi"};
  EXPECT_EQ(parse_json(activity_line(2.5, 1, flies)),
            Json::parse(R"({"k":"activity","t":2.5,"u":1,"m":"flies to a \"goal\"","g":[100,-200,301],
                            "w":"changi","n":""})"));
  const Activity stands{.mode = "has no goal", .no_way = "too \xff near"};
  EXPECT_EQ(parse_json(activity_line(2.5, 1, stands))["g"], nullptr);
  EXPECT_EQ(parse_json(numbers_json(std::vector<std::optional<ShownNumbers>>{
                {{1.234, 7, 0.0154}}, std::nullopt, {{0.0, 0, std::nullopt}}})),
            Json::parse("[[123,7,15],null,[0,0,null]]"));
}

TEST(StoryLines, HaveCapturesAndLinks) {
  const Json capture = parse_json(capture_line(1.0, 2, 7, {{5, 0.5F, 0.25F, 0.125F, 0.75F}, {9, 1, 1, 1, 1}}));
  EXPECT_EQ(capture["u"], 2);
  EXPECT_EQ(capture["c"], 7);
  EXPECT_EQ(capture["p"], Json::parse("[5,125000,500,750,4,1000000,1000,1000]"));
  const Json poor =
      parse_json(capture_line(1.0, 0, 0, {{5, 1.0F, 1.0F, 0.1999999F, 1.0F}, {6, 1.0F, 1.0F, 0.2F, 1.0F}}));
  EXPECT_EQ(poor["p"][1], 199999)
      << "the picture does not count, so its quality must not be rounded up to the threshold";
  EXPECT_EQ(poor["p"][5], 200000);
  using enum ShownLink;
  EXPECT_EQ(parse_json(links_line(1.0, std::vector{blocked, linked, cut, dead}))["l"], "0123");
  EXPECT_EQ(parse_json(delivered_line(3.5, std::vector<ShownDelivery>{{2, 7}, {0, 9}})),
            Json::parse(R"({"k":"delivered","t":3.5,"d":[2,7,0,9]})"));
  EXPECT_EQ(parse_json(estimate_line(0.5, std::vector{1.0F, 0.25F, 0.0F, 0.5F}, std::vector<std::uint8_t>{1, 0, 0, 0})),
            Json::parse(R"({"k":"estimate","t":0.5,"q":[1000000,250000,0,500000],"no":[1,2]})"));
  EXPECT_EQ(parse_json(void_line(3.5, 2)), Json::parse(R"({"k":"void","t":3.5,"u":2})"));
}

}  // namespace
}  // namespace skein::view
