#include "core/topics.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

namespace skein {
namespace {

TEST(Topics, WireNamesAreThoseOfRos2) {
  EXPECT_EQ(wire_topic("/jurong/gimbal"), "rt/jurong/gimbal");
  EXPECT_EQ(wire_type("nav_msgs/msg/Odometry"), "nav_msgs::msg::dds_::Odometry_");
  const topics::WireTopic odometry = topics::odometry("jurong");
  EXPECT_EQ(odometry.name, "rt/jurong/ground_truth/odometry");
  EXPECT_EQ(odometry.type, "nav_msgs::msg::dds_::Odometry_");
}

TEST(Topics, MalformedNamesAreRefused) {
  for (const char* name : {"", "x", "/", "/x/", "//x", "/x y", "/1x", "/x/2", "/x-y", "/\xc3\xa9"}) {
    EXPECT_THROW(wire_topic(name), InputError) << name;
  }
  for (const char* type : {"", "String", "std_msgs/String", "std_msgs/srv/String", "std_msgs/msg/", "/msg/String",
                           "std_msgs/msg/String/x", "std_msgs::msg::String"}) {
    EXPECT_THROW(wire_type(type), InputError) << type;
  }
}

TEST(Topics, NamesThatDdsCannotCarryAreRefused) {
  const std::string most(kMostNameBytes - std::string("rt/").size(), 'x');
  EXPECT_EQ(wire_topic("/" + most).size(), kMostNameBytes);
  EXPECT_THROW(wire_topic("/" + most + "x"), InputError);
  EXPECT_THROW(wire_topic("/" + std::string(1 << 20, 'x')), InputError);
  EXPECT_THROW(wire_type("std_msgs/msg/" + std::string(kMostNameBytes, 'X')), InputError);
  const std::string longest(kMostNameBytes - topics::debug("jurong", "").name.size(), 'x');
  EXPECT_EQ(topics::debug_name(topics::debug("jurong", longest).name, "jurong"), longest);
  EXPECT_EQ(topics::debug_name(topics::debug("jurong", longest + "x").name, "jurong"), "");
}

TEST(Topics, EveryEntryOfTheTablesIsWellFormedAndUnique) {
  for (const auto table :
       {topics::uav_topics(), topics::gcs_topics(), topics::viewer_topics(), topics::lockstep_topics()}) {
    std::set<std::string> names;
    for (const topics::TopicInfo& topic : table) {
      const topics::WireTopic wire = topics::wire(topic, "jurong");
      EXPECT_TRUE(names.insert(wire.name).second) << wire.name;
      EXPECT_GT(wire.depth, 0) << wire.name;
      EXPECT_FALSE(topic.rate.empty()) << wire.name;
      EXPECT_EQ(topic.cloud != nullptr, topic.type == "sensor_msgs/msg/PointCloud2") << wire.name;
    }
  }
}

/// Everything that the server writes into a UAV's domain, except the lock-step's messages and what other nodes send by
/// radio. If you add a topic here, make sure that it has neither data of the referee nor ground truth: no score of the
/// fleet, no points that this UAV's camera has not seen, no position without the odometry's error, nothing of the mesh.
TEST(Topics, AUavReceivesOnlyWhatItsOwnSensorsAndItsRadioTell) {
  std::set<std::string_view> received;
  for (const topics::TopicInfo& topic : topics::uav_topics()) {
    const bool is_from_agent = topic.direction == topics::Direction::from_agent ||
                               topic.direction == topics::Direction::shown_by_agent ||
                               topic.pattern == topics::kCaptureStored.pattern;
    if (!is_from_agent) received.insert(topic.pattern);
  }
  const std::set<std::string_view> expected = {"/{id}/ground_truth/odometry",
                                               "/{id}/gimbal",
                                               "/{id}/battery",
                                               "/{id}/wind",
                                               "/{id}/radio_links",
                                               "/{id}/cloud_inW",
                                               "/{id}/lidar_servo",
                                               "/{id}/slf_kf_cloud",
                                               "/{id}/nbr_kf_cloud",
                                               "/{id}/nbr_odom_cloud",
                                               "/{id}/detected_interest_points",
                                               "/skein/detected",
                                               "/{id}/mission_duration_remained",
                                               "/clock",
                                               "/gcs/bounding_box_vertices",
                                               "/{id}/command_rejected",
                                               "/{id}/hand",
                                               "/skein/capture"};
  EXPECT_EQ(received, expected);
  for (const topics::TopicInfo& topic : topics::score_topics()) {
    for (const topics::TopicInfo& own : topics::uav_topics()) EXPECT_NE(own.pattern, topic.pattern);
  }
}

TEST(Topics, TheTriggerHasBothItsNames) {
  std::set<std::string> names;
  for (const topics::TopicInfo& topic : topics::uav_topics()) names.insert(topics::wire(topic, "changi").name);
  EXPECT_TRUE(names.contains("rt/changi/command/camera_trigger"));
  EXPECT_TRUE(names.contains("rt/changi/command/trigger"));
}

TEST(Topics, FieldsOfACloudLieSideBySide) {
  for (const topics::CloudLayout& layout : {topics::kScanLayout, topics::kNeighbourLayout, topics::kDetectionLayout}) {
    std::uint32_t end = 0;
    for (const topics::CloudField& field : layout.fields) {
      const std::uint32_t size = field.type == topics::FieldType::float64 ? 8 : 4;
      EXPECT_EQ(field.offset, end) << field.name;
      EXPECT_EQ(field.offset % size, 0U) << field.name;
      end += size;
    }
    EXPECT_EQ(layout.point_step, end);
  }
}

TEST(Topics, DomainsFollowTheFleetOrder) {
  EXPECT_EQ(world_domain(10), 10);
  EXPECT_EQ(gcs_domain(10), 11);
  EXPECT_EQ(uav_domain(10, UavIndex{3}), 15);
  EXPECT_EQ(node_domain(10, kStationNode), gcs_domain(10));
  EXPECT_EQ(node_domain(10, node_of_uav(UavIndex{3})), uav_domain(10, UavIndex{3}));
}

}  // namespace
}  // namespace skein
