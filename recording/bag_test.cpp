#include "recording/bag.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include "core/topics.hpp"
#include "recording/recorder.hpp"
#include "results/run_folder.hpp"

namespace skein::recording {
namespace {

namespace fs = std::filesystem;

// Values of enumerations of rmw, as rosbag2 of ROS 2 Humble writes them.
constexpr int kTransientLocal = 1, kVolatile = 2;

TEST(Bag, OffersATopicWithTheQosThatItHasOnTheWire) {
  const auto expect = [](const topics::TopicInfo& info, const std::string& topic) {
    const YAML::Node qos = YAML::Load(offered_qos_profiles(topic));
    ASSERT_EQ(qos.size(), 1U) << topic;
    EXPECT_EQ(qos[0]["history"].as<int>(), 1) << topic;
    EXPECT_EQ(qos[0]["reliability"].as<int>(), 1) << topic;
    EXPECT_EQ(qos[0]["durability"].as<int>(), info.latched ? kTransientLocal : kVolatile) << topic;
    EXPECT_EQ(qos[0]["depth"].as<int>(), info.depth) << topic;
    EXPECT_EQ(qos[0]["deadline"]["sec"].as<long long>(), 9223372036LL);
  };
  for (const topics::TopicInfo& info : topics::viewer_topics()) expect(info, std::string(info.pattern));
  for (const topics::TopicInfo& info : topics::uav_topics()) {
    if (info.pattern == topics::kBoundingBoxes.pattern) continue;  // it is recorded only in the station's domain
    const std::string topic = topics::wire(info, "jurong").name.substr(2);
    expect(info, topic.starts_with("/jurong/") ? topic : "/jurong" + topic);
  }
  expect(topics::kBoundingBoxes, "/gcs/bounding_box_vertices");
  EXPECT_EQ(YAML::Load(offered_qos_profiles("/jurong/plan"))[0]["durability"].as<int>(), kVolatile) << "a radio topic";
}

TEST(Bag, MetadataCountsWhatAPlayerCanPublish) {
  const fs::path folder = fs::temp_directory_path() / ("skein-bag-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const fs::path part = folder / run_folder::recording_part("sim_server", 0);
  {
    Recorder recorder(folder, "sim_server", Scope::run);
    for (const Tick tick : {40, 20, 400}) {
      recorder.set_time(tick);
      recorder.add("/tf_static", msg::TFMessage());
      if (tick != 20) recorder.add("/jurong/debug/x", msg::Float64());
      recorder.add("/jurong/own", "own::msg::dds_::Unknown_", encode(msg::String()));
    }
    recorder.close();
  }
  const YAML::Node bag = YAML::Load(bag_metadata(part))["rosbag2_bagfile_information"];
  EXPECT_EQ(bag["version"].as<int>(), 5);
  EXPECT_EQ(bag["storage_identifier"].as<std::string>(), "mcap");
  EXPECT_EQ(bag["relative_file_paths"][0].as<std::string>(), part.filename());
  EXPECT_EQ(bag["message_count"].as<int>(), 5);
  EXPECT_EQ(bag["starting_time"]["nanoseconds_since_epoch"].as<long long>(), 50'000'000);
  EXPECT_EQ(bag["duration"]["nanoseconds"].as<long long>(), 950'000'000);
  const YAML::Node topics = bag["topics_with_message_count"];
  ASSERT_EQ(topics.size(), 2U) << "a topic of an unknown type is left out";
  EXPECT_EQ(topics[0]["topic_metadata"]["name"].as<std::string>(), "/jurong/debug/x");
  EXPECT_EQ(topics[0]["message_count"].as<int>(), 2);
  EXPECT_EQ(topics[1]["topic_metadata"]["type"].as<std::string>(), "tf2_msgs/msg/TFMessage");
  EXPECT_EQ(topics[1]["topic_metadata"]["offered_qos_profiles"].as<std::string>(), offered_qos_profiles("/tf_static"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace skein::recording
