#include "recording/bag.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include "core/topics.hpp"
#include "recording/mcap/reader.hpp"

namespace skein::recording {
namespace {

// Values of the enumerations of rmw.
constexpr int kKeepLast = 1, kReliable = 1, kTransientLocal = 1, kVolatile = 2, kAutomatic = 1;
constexpr int kOtherDepth = 64;  ///< for topics that are not in the tables: radio topics and debug values
constexpr int kLatchedDepth = 1;

/// Whether `info` describes a recorded topic. "/jurong/clock" is /clock in jurong's domain, "/jurong/gimbal" is
/// /{id}/gimbal.
bool is(const topics::TopicInfo& info, std::string_view topic) {
  if (info.pattern == topic) return true;
  const std::size_t end = topic.find('/', 1);
  if (end == std::string_view::npos) return false;
  const std::string_view id = topic.substr(1, end - 1);
  return topics::wire(info, id).name == wire_topic(topic) || info.pattern == topic.substr(end);
}

const topics::TopicInfo* find(std::string_view topic) {
  for (const auto table : {topics::viewer_topics(), topics::uav_topics(), topics::gcs_topics()}) {
    const auto found = std::ranges::find_if(table, [&](const topics::TopicInfo& info) { return is(info, topic); });
    if (found != table.end()) return &*found;
  }
  return nullptr;
}

struct Counted {
  std::string type, qos;
  std::uint64_t messages = 0;
};

}  // namespace

std::string offered_qos_profiles(std::string_view topic) {
  const topics::TopicInfo* const known = find(topic);
  const bool latched = known != nullptr && known->latched;
  const int depth = latched ? kLatchedDepth : known != nullptr ? known->depth : kOtherDepth;
  const auto for_ever = [](const char* name) {
    return fmt::format("  {}:\n    sec: 9223372036\n    nsec: 854775807\n", name);
  };
  return fmt::format("- history: {}\n  depth: {}\n  reliability: {}\n  durability: {}\n", kKeepLast, depth, kReliable,
                     latched ? kTransientLocal : kVolatile) +
         for_ever("deadline") + for_ever("lifespan") + fmt::format("  liveliness: {}\n", kAutomatic) +
         for_ever("liveliness_lease_duration") + "  avoid_ros_namespace_conventions: false";
}

std::string bag_metadata(const std::filesystem::path& recording) {
  mcap::Reader reader(recording);
  std::map<std::string, Counted> counted;
  std::uint64_t first = UINT64_MAX, last = 0, messages = 0;
  reader.messages([&](const mcap::Channel& channel, const mcap::Message& message) {
    const auto schema = reader.schemas().find(channel.schema_id);
    if (schema == reader.schemas().end()) return;
    Counted& topic = counted[channel.topic];
    topic.type = schema->second.name;
    const auto qos = channel.metadata.find("offered_qos_profiles");
    if (qos != channel.metadata.end()) topic.qos = qos->second;
    ++topic.messages;
    ++messages;
    first = std::min(first, message.log_time);
    last = std::max(last, message.log_time);
  });
  if (messages == 0) first = last = 0;
  const std::string file = recording.filename();
  YAML::Emitter out;
  const auto times = [&] {
    out << YAML::Key << "starting_time" << YAML::Value << YAML::BeginMap << YAML::Key << "nanoseconds_since_epoch"
        << YAML::Value << first << YAML::EndMap;
    out << YAML::Key << "duration" << YAML::Value << YAML::BeginMap << YAML::Key << "nanoseconds" << YAML::Value
        << last - first << YAML::EndMap;
    out << YAML::Key << "message_count" << YAML::Value << messages;
  };
  out << YAML::BeginMap << YAML::Key << "rosbag2_bagfile_information" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "version" << YAML::Value << 5;
  out << YAML::Key << "storage_identifier" << YAML::Value << "mcap";
  times();
  out << YAML::Key << "topics_with_message_count" << YAML::Value << YAML::BeginSeq;
  for (const auto& [name, topic] : counted) {
    out << YAML::BeginMap << YAML::Key << "topic_metadata" << YAML::Value << YAML::BeginMap;
    out << YAML::Key << "name" << YAML::Value << name << YAML::Key << "type" << YAML::Value << topic.type;
    out << YAML::Key << "serialization_format" << YAML::Value << "cdr";
    out << YAML::Key << "offered_qos_profiles" << YAML::Value << YAML::DoubleQuoted << topic.qos << YAML::EndMap;
    out << YAML::Key << "message_count" << YAML::Value << topic.messages << YAML::EndMap;
  }
  out << YAML::EndSeq;
  out << YAML::Key << "compression_format" << YAML::Value << YAML::DoubleQuoted << "";
  out << YAML::Key << "compression_mode" << YAML::Value << YAML::DoubleQuoted << "";
  out << YAML::Key << "relative_file_paths" << YAML::Value << YAML::BeginSeq << file << YAML::EndSeq;
  out << YAML::Key << "files" << YAML::Value << YAML::BeginSeq << YAML::BeginMap;
  out << YAML::Key << "path" << YAML::Value << file;
  times();
  out << YAML::EndMap << YAML::EndSeq << YAML::EndMap << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace skein::recording
