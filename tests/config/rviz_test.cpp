// The configurations of RViz: config/skein.rviz shows the topics of a run for viewers; ros2/skein_ros/rviz/uav.rviz
// shows the topics that a UAV receives and those that its agent publishes. Each shown topic exists, with the type that
// its display needs, and no topic is missing.
#include <gtest/gtest.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <span>
#include <string>

#include "core/topics.hpp"
#include "tests/support/places.hpp"

namespace skein {
namespace {

class RvizConfig : public testing::Test {
 protected:
  const YAML::Node manager_ = YAML::LoadFile(source_path("config/skein.rviz"))["Visualization Manager"];
};

/// "visualization_msgs/msg/Marker" -> "rviz_default_plugins/Marker"
std::string display_of(std::string_view type) {
  return "rviz_default_plugins/" + std::string(type.substr(type.rfind('/') + 1));
}

TEST_F(RvizConfig, ShowsEveryTopicForViewers) {
  EXPECT_EQ(manager_["Global Options"]["Fixed Frame"].as<std::string>(), "world");
  std::set<std::string> shown, plugins;
  for (const YAML::Node& display : manager_["Displays"]) {
    const auto plugin = display["Class"].as<std::string>();
    plugins.insert(plugin);
    EXPECT_TRUE(display["Enabled"].as<bool>()) << plugin;
    if (!display["Topic"]) continue;
    const auto name = display["Topic"]["Value"].as<std::string>();
    const auto table = topics::viewer_topics();
    const auto topic = std::ranges::find(table, name, &topics::TopicInfo::pattern);
    ASSERT_NE(topic, table.end()) << name << " does not exist";
    EXPECT_EQ(plugin, display_of(topic->type)) << name;
    // A reader with a weaker durability misses earlier samples; one with a stronger durability does not match.
    EXPECT_EQ(display["Topic"]["Durability Policy"].as<std::string>(), topic->latched ? "Transient Local" : "Volatile")
        << name;
    EXPECT_EQ(display["Topic"]["Reliability Policy"].as<std::string>(), "Reliable") << name;
    EXPECT_TRUE(shown.insert(name).second) << name << " appears twice";
  }
  EXPECT_TRUE(plugins.contains("rviz_default_plugins/TF"));
  for (const topics::TopicInfo& topic : topics::viewer_topics()) {
    if (topic.pattern.starts_with("/viz/")) {
      EXPECT_TRUE(shown.contains(std::string(topic.pattern))) << topic.pattern << " is missing";
    }
  }
}

/// The topics that the displays show. Fails if one is not in `table`, or a display does not fit its topic.
std::set<std::string> shown_by(const YAML::Node& manager, std::span<const topics::TopicInfo> table,
                               const std::string& id) {
  std::set<std::string> shown;
  for (const YAML::Node& display : manager["Displays"]) {
    if (!display["Topic"]) continue;
    const auto name = display["Topic"]["Value"].as<std::string>();
    const auto topic = std::ranges::find_if(
        table, [&](const topics::TopicInfo& info) { return topics::wire(info, id).name == "rt" + name; });
    if (topic == table.end()) {
      ADD_FAILURE() << name << " does not exist";
      continue;
    }
    const std::string octomap = "octomap_msgs/msg/Octomap";
    EXPECT_EQ(display["Class"].as<std::string>(),
              topic->type == octomap ? "octomap_rviz_plugins/OccupancyGrid" : display_of(topic->type));
    EXPECT_EQ(display["Topic"]["Durability Policy"].as<std::string>(), topic->latched ? "Transient Local" : "Volatile")
        << name;
    EXPECT_EQ(display["Topic"]["Reliability Policy"].as<std::string>(), "Reliable") << name;
    EXPECT_EQ(display["Topic"]["Depth"].as<int>(), topic->depth) << name;
    if (const YAML::Node channel = display["Channel Name"]) {
      const auto is_it = [&](const topics::CloudField& field) { return field.name == channel.as<std::string>(); };
      EXPECT_TRUE(topic->cloud != nullptr && std::ranges::any_of(topic->cloud->fields, is_it)) << name;
    }
    EXPECT_TRUE(shown.insert(name).second) << name << " appears twice";
  }
  return shown;
}

class UavRvizConfig : public testing::Test {
 protected:
  const YAML::Node manager_ = YAML::LoadFile(source_path("ros2/skein_ros/rviz/uav.rviz"))["Visualization Manager"];
};

TEST_F(UavRvizConfig, ShowsTheTopicsThatAUavReceives) {
  EXPECT_EQ(manager_["Global Options"]["Fixed Frame"].as<std::string>(), "world");
  const std::set<std::string> shown = shown_by(manager_, topics::uav_topics(), "uav");
  for (const topics::TopicInfo& topic : topics::uav_topics()) {
    const bool is_shape = topic.type == "sensor_msgs/msg/PointCloud2" || topic.type == "sensor_msgs/msg/PointCloud" ||
                          topic.type == "nav_msgs/msg/Odometry";
    const std::string name = topics::wire(topic, "uav").name.substr(2);
    if (is_shape && topic.direction == topics::Direction::to_agent) {
      EXPECT_TRUE(shown.contains(name)) << name << " is missing";
    }
  }
  EXPECT_TRUE(shown.contains("/uav/octomap"));
}

// ROS's launch packages are not installed: run_launch.py replaces their modules.
TEST_F(UavRvizConfig, TheLaunchFileStartsItForOneUav) {
  const std::string answer = testing::TempDir() + "launch-" + std::to_string(::getpid()) + ".json";
  const std::string command = "python3 " + source_path("tests/config/run_launch.py ") +
                              source_path("ros2/skein_ros/launch/rviz.launch.py") + " >" + answer;
  ASSERT_EQ(std::system(command.c_str()), 0);
  const YAML::Node actions = YAML::LoadFile(answer);  // JSON is YAML
  std::remove(answer.c_str());
  std::set<std::string> arguments;
  YAML::Node node, variable;
  for (const YAML::Node& action : actions) {
    if (action["DeclareLaunchArgument"]) arguments.insert(action["DeclareLaunchArgument"][0][0].as<std::string>());
    if (action["SetEnvironmentVariable"]) variable = action["SetEnvironmentVariable"][0];
    if (action["Node"]) node = action["Node"][1];
  }
  EXPECT_EQ(arguments, (std::set<std::string>{"domain", "uav"}));
  EXPECT_EQ(variable[0].as<std::string>(), "ROS_DOMAIN_ID");
  EXPECT_EQ(variable[1]["argument"].as<std::string>(), "domain");
  EXPECT_EQ(node["executable"].as<std::string>(), "rviz2");
  EXPECT_EQ(node["arguments"][1].as<std::string>(), "share/skein_ros/rviz/uav.rviz");
  EXPECT_TRUE(node["parameters"][0]["use_sim_time"].as<bool>());
  std::set<std::string> led;
  for (const YAML::Node& pair : node["remappings"]) {
    std::string to;
    for (const YAML::Node& part : pair[1]) to += part.IsMap() ? "jurong" : part.as<std::string>();
    const auto from = pair[0].as<std::string>();
    EXPECT_EQ(to, "/jurong/" + from.substr(std::string("/uav/").size()));
    led.insert(from);
  }
  std::set<std::string> shown = shown_by(manager_, topics::uav_topics(), "uav");
  shown.erase("/gcs/bounding_box_vertices");  // its name is the same in every domain
  EXPECT_EQ(led, shown);
}

}  // namespace
}  // namespace skein
