// A ROS 2 node that subscribes in the world domain as RViz 2 does: what it receives, and whether Skein's messages are
// those of ROS 2. The tests' ROS 2 lacks visualization_msgs and tf2_msgs, which are therefore built from Skein's IDL.
#include <algorithm>
#include <cmath>

#include "core/topics.hpp"
#include "packages_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

const Arguments kWatched = {"towers", "--planner", "patrol", "--stop-at", "40"};

class Ros2Definitions : public Ros2Test {};

TEST_F(Ros2Definitions, AgreeWithSkeinsIdl) {
  ChildProcess& compare = start_node("compare", "cyclonedds", 1, "",
                                     "python3 " + source_path("tests/ros2/definitions.py") + " " + source_path("idl"));
  ASSERT_EQ(compare.wait().code, 0) << compare.err();
  const Json found = Json::parse(compare.out());
  EXPECT_EQ(found["different"], Json::array());
  EXPECT_GE(found["same"].size(), 24U);
  for (const Json& name : found["missing"]) {
    const std::string type = name;
    const bool known =
        type.starts_with("skein_msgs/") || type.starts_with("visualization_msgs/") || type.starts_with("tf2_msgs/") ||
        type.starts_with("octomap_msgs/") || type.starts_with("diagnostic_msgs/") || type == "std_msgs/Float64" ||
        type == "sensor_msgs/CompressedImage" || type == "sensor_msgs/JointState" || type == "sensor_msgs/BatteryState";
    EXPECT_TRUE(known) << type << " is not in ROS 2";
  }
}

class Ros2Viewer : public ExtraMessagesTest, public testing::WithParamInterface<std::string> {
 protected:
  ChildProcess& start_viewer(const std::string& middleware, int domain) {
    return start_looker(middleware, domain, "python3 " + source_path("tests/ros2/viewer.py") + " " + file(middleware));
  }

  void expect_all_seen(const SkeinRun& run, const std::string& viewer) const;
};

void Ros2Viewer::expect_all_seen(const SkeinRun& run, const std::string& viewer) const {
  SCOPED_TRACE(viewer);
  const Json seen = Json::parse(text_of(file(viewer)));
  for (const topics::TopicInfo& topic : topics::viewer_topics()) {
    EXPECT_EQ(seen["types"][std::string(topic.pattern)], Json({std::string(topic.type)}));
  }
  std::set<std::string> names, kinds, expected(kFleet.begin(), kFleet.end());
  expected.insert("gcs");
  for (const Json& marker : seen["fleet"]) names.insert(marker[0]);
  names.erase("");
  EXPECT_EQ(names, expected);
  for (const Json& marker : seen["markers"]) {
    kinds.insert(marker["name"]);
    EXPECT_EQ(marker["frame"], "world");
    EXPECT_GT(marker["alpha"], 0.0);
    EXPECT_TRUE(marker["colors"] == 0 || marker["colors"] == marker["points"]);
    EXPECT_EQ(marker["rest"], Json({"", "", Json::array(), 0, "", "", Json::array(), false}))
        << "fields that Skein leaves empty are not empty in ROS 2";
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"body", "boxes", "frustum", "links", "name", "path", "structure"}));
  ASSERT_FALSE(seen["clouds"].empty());
  for (const Json& cloud : seen["clouds"]) EXPECT_EQ(cloud[1], Json({"x", "y", "z", "intensity"}));

  std::map<std::string, std::string> parents;
  std::map<std::pair<std::string, long>, Json> places;
  for (const Json& frame : seen["frames"]) {
    parents[frame[2]] = frame[1];
    places[{frame[2], std::lround(frame[0].get<double>() * 20.0)}] = frame[3];
  }
  std::size_t compared = 0;
  for (const std::string& uav : kFleet) {
    EXPECT_EQ(parents[uav + "/base_link"], "world");
    EXPECT_EQ(parents[uav + "/gimbal"], uav + "/base_link");
    EXPECT_EQ(parents[uav + "/camera"], uav + "/gimbal");
  }
  for (const auto& row : read_csv(run.dir() / "trajectories.csv")) {
    const auto place = places.find({row.at("uav") + "/base_link", std::lround(std::stod(row.at("time_s")) * 20.0)});
    if (place == places.end()) continue;
    ++compared;
    const char* axes[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(place->second[i].get<double>(), std::stod(row.at(axes[i])), 1e-3);
  }
  EXPECT_GT(compared, 100U);
}

TEST_P(Ros2Viewer, ReceivesWhatRvizShows) {
  SkeinRun& fleet = start("fleet", joined(kWatched, {"--dds", GetParam(), "--debug", "changi"}));
  ASSERT_TRUE(fleet.wait_for("gdb --args")) << fleet.err();
  const int world = world_domain(fleet.domains().first);
  const std::vector<std::string> viewers = {"cyclonedds", "fastrtps"};
  std::vector<ChildProcess*> nodes;
  for (const std::string& middleware : viewers) nodes.push_back(&start_viewer(middleware, world));
  ASSERT_TRUE(eventually([&] { return std::ranges::all_of(viewers, [&](const auto& v) { return ready(v); }); }))
      << nodes[0]->err() << nodes[1]->err();
  start_agent(fleet);
  ASSERT_EQ(fleet.exit_code(), 0) << fleet.err();
  for (ChildProcess* node : nodes) EXPECT_EQ(node->wait().code, 0) << node->err();
  for (const std::string& viewer : viewers) expect_all_seen(fleet, viewer);
  EXPECT_EQ(fleet.digest(), run("alone", kWatched).digest());
}

INSTANTIATE_TEST_SUITE_P(Vendors, Ros2Viewer, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

}  // namespace
}  // namespace skein::test
