// config/skein.rviz shows what a run writes for viewers: each of its topics is in the table, of the kind that its
// display takes, and none is left out.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <set>
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
    // Who asks for less does not get what was written before; who asks for more gets nothing.
    EXPECT_EQ(display["Topic"]["Durability Policy"].as<std::string>(), topic->latched ? "Transient Local" : "Volatile")
        << name;
    EXPECT_EQ(display["Topic"]["Reliability Policy"].as<std::string>(), "Reliable") << name;
    EXPECT_TRUE(shown.insert(name).second) << name << " is there twice";
  }
  EXPECT_TRUE(plugins.contains("rviz_default_plugins/TF"));
  for (const topics::TopicInfo& topic : topics::viewer_topics()) {
    if (topic.pattern.starts_with("/viz/")) {
      EXPECT_TRUE(shown.contains(std::string(topic.pattern))) << topic.pattern << " is missing";
    }
  }
}

}  // namespace
}  // namespace skein
