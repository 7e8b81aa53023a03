// A ROS 2 node that subscribes in a UAV's domain with the settings of ros2/skein_ros/rviz/uav.rviz, in place of RViz 2:
// each display gets its topic, with its type and in the frames of tf; the node also gets the agent's diagnostics.
#include <algorithm>
#include <cmath>

#include "core/topics.hpp"
#include "packages_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

class UavViewer : public ExtraMessagesTest, public testing::WithParamInterface<std::string> {};

void expect_displays(const Json& seen) {
  ASSERT_EQ(seen["shown"].size(), 8U);
  for (const auto& [topic, display] : seen["shown"].items()) {
    SCOPED_TRACE(topic);
    EXPECT_EQ(display["wire"], Json({display["type"]}));
    // In so short a flight, an explorer may detect no point.
    if (topic == "/jurong/detected_interest_points" && display["samples"] == 0) continue;
    EXPECT_GT(display["samples"], 0);
    EXPECT_EQ(display["frames"], Json({"world"}));
  }
}

/// Expects only the UAV's own frames, each with one parent, at the positions of its odometry.
void expect_frames(const Json& seen) {
  std::map<std::string, std::string> parents;
  std::map<long, Json> places;
  const auto step_of = [](const Json& time_s) { return std::lround(time_s.get<double>() * 20.0); };
  for (const Json& frame : seen["frames"]) {
    const auto [at, fresh] = parents.emplace(frame[2], frame[1]);
    EXPECT_TRUE(fresh || at->second == frame[1]) << frame;
    if (frame[2] == "jurong/base_link") places[step_of(frame[0])] = frame[3];
  }
  EXPECT_EQ(parents, (std::map<std::string, std::string>{{"jurong/odom", "world"},
                                                         {"jurong/base_link", "jurong/odom"},
                                                         {"jurong/gimbal", "jurong/base_link"},
                                                         {"jurong/camera", "jurong/gimbal"},
                                                         {"jurong/lidar", "jurong/base_link"}}));
  std::size_t compared = 0;
  for (const Json& odometry : seen["odometry"]) {
    const auto place = places.find(step_of(odometry[0]));
    if (place == places.end()) continue;
    ++compared;
    EXPECT_EQ(place->second, odometry[1]);
  }
  EXPECT_GT(compared, 100U);
}

void expect_diagnostics(const Json& seen) {
  ASSERT_GT(seen["diagnostics"].size(), 10U) << "diagnostics must arrive once per second";
  double before_s = -1.0;
  bool linked = false;
  for (const Json& array : seen["diagnostics"]) {
    const double time_s = array[0];
    EXPECT_GT(time_s, before_s + 0.99);
    before_s = time_s;
    const Json& parts = array[1];
    ASSERT_GE(parts.size(), 4U) << "the four parts, and the battery";
    EXPECT_EQ(parts[0][0], "jurong: radio");
    linked |= parts[0][2] == "linked to the station" && parts[0][1] == 0;
    EXPECT_EQ(std::stol(parts[3][3]["step"].get<std::string>()), std::lround(time_s * 20.0));
  }
  const Json &first = seen["diagnostics"].front()[1][2], &last = seen["diagnostics"].back()[1][2];
  EXPECT_EQ(first[1], 1) << "on the ground, the UAV must report that no space is proved free";
  EXPECT_EQ(last[1], 0) << last;
  EXPECT_EQ(last[2], "within proved space");
  EXPECT_TRUE(linked) << "the UAV has never reported a link, although the station is in sight of its start";
}

TEST_P(UavViewer, SeesOnlyWhatItsUavReceivesAndPublishes) {
  // The flight has odometry errors, to show that the frames do not contain the true position.
  const Arguments flight = {"towers", "--planner", "patrol",       "--stop-at", "30",
                            "--seed", "3",         "--conditions", "breezy"};
  SkeinRun& fleet = start("fleet", joined(flight, {"--dds", GetParam(), "--debug", "changi"}));
  ASSERT_TRUE(fleet.wait_for("gdb --args")) << fleet.err();
  const int domain = uav_domain(fleet.domains().first, UavIndex{0});
  const std::string config = source_path("ros2/skein_ros/rviz/uav.rviz");
  const std::vector<std::string> middlewares = {"cyclonedds", "fastrtps"};
  std::vector<ChildProcess*> nodes;
  for (const std::string& middleware : middlewares) {
    nodes.push_back(&start_looker(
        middleware, domain,
        "python3 " + source_path("tests/ros2/uav_viewer.py") + " " + config + " jurong " + file(middleware)));
  }
  ASSERT_TRUE(eventually([&] { return std::ranges::all_of(middlewares, [&](const auto& m) { return ready(m); }); }))
      << nodes[0]->err() << nodes[1]->err();
  start_agent(fleet);
  ASSERT_EQ(fleet.exit_code(), 0) << fleet.err();
  for (ChildProcess* node : nodes) EXPECT_EQ(node->wait().code, 0) << node->err();
  for (const std::string& middleware : middlewares) {
    SCOPED_TRACE(middleware);
    const Json seen = Json::parse(text_of(file(middleware)));
    expect_displays(seen);
    expect_frames(seen);
    expect_diagnostics(seen);
  }
  EXPECT_EQ(fleet.digest(), run("alone", flight).digest()) << "a viewer changed the run";
}

INSTANTIATE_TEST_SUITE_P(Vendors, UavViewer, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

}  // namespace
}  // namespace skein::test
