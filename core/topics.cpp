#include "core/topics.hpp"

#include <array>
#include <cctype>
#include <vector>

#include "core/messages/view_topics.hpp"
#include "core/scenario/scenario.hpp"
#include "core/text/text.hpp"

namespace skein {
namespace {

/// @returns `name`. @throws InputError if it is too long for DDS.
/// @param given  the name as the user wrote it @param what  kind of name, for the message
std::string bounded(std::string name, std::string_view given, const char* what) {
  if (name.size() <= kMostNameBytes) return name;
  throw InputError("'" + shortened(std::string(given)) + "' is too long: the name of " + what + " may have " +
                   std::to_string(kMostNameBytes) + " characters in DDS, not " + std::to_string(name.size()));
}

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// A ROS name token: letters, digits and underscores, not beginning with a digit.
bool is_token(std::string_view text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) != 0) return false;
  for (const char c : text) {
    if (!is_name_character(c)) return false;
  }
  return true;
}

/// "a/b/c" -> {"a", "b", "c"}; empty parts are kept.
std::vector<std::string_view> split_at_slashes(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t slash = text.find('/');
    parts.push_back(text.substr(0, slash));
    if (slash == std::string_view::npos) return parts;
    text.remove_prefix(slash + 1);
  }
}

}  // namespace

std::vector<std::string> domain_names(const Scenario& scenario) {
  std::vector<std::string> names = {"world", "gcs"};
  for (const UavConfig& uav : scenario.fleet) names.push_back(uav.name);
  return names;
}

bool is_topic_name(std::string_view text) {
  const std::vector<std::string_view> parts = split_at_slashes(text);
  bool valid = parts.size() >= 2 && parts.front().empty();
  for (std::size_t i = 1; i < parts.size(); ++i) valid = valid && is_token(parts[i]);
  return valid;
}

std::string wire_topic(std::string_view ros_topic) {
  if (!is_topic_name(ros_topic)) {
    throw InputError("'" + std::string(ros_topic) +
                     "' is not an absolute topic name; write it like '/broadcast': after each '/' letters, "
                     "digits and '_', not beginning with a digit");
  }
  return bounded("rt" + std::string(ros_topic), ros_topic, "a topic");
}

std::string wire_type(std::string_view ros_type) {
  const std::vector<std::string_view> parts = split_at_slashes(ros_type);
  if (parts.size() != 3 || parts[1] != "msg" || !is_token(parts[0]) || !is_token(parts[2])) {
    throw InputError("'" + std::string(ros_type) + "' is not a message type; write it like 'std_msgs/msg/String'");
  }
  return bounded(std::string(parts[0]) + "::msg::dds_::" + std::string(parts[2]) + "_", ros_type, "a type");
}

namespace topics {

std::string_view debug_name(std::string_view wire_topic, std::string_view id) {
  const std::string prefix = debug(id, "").name;
  if (!wire_topic.starts_with(prefix) || wire_topic.size() > kMostNameBytes) return {};
  const std::string_view name = wire_topic.substr(prefix.size());
  return is_token(name) ? name : std::string_view();
}

WireTopic wire(const TopicInfo& topic, std::string_view id) {
  static constexpr std::string_view kPlaceholder = "{id}";
  std::string name(topic.pattern);
  if (const std::size_t at = name.find(kPlaceholder); at != std::string::npos) {
    name.replace(at, kPlaceholder.size(), id);
  }
  return {wire_topic(name), wire_type(topic.type), topic.latched, topic.depth};
}

std::span<const TopicInfo> uav_topics() {
  static constexpr std::array kAll{kOdometry,
                                   kGimbal,
                                   kBattery,
                                   kWind,
                                   kRadioLinks,
                                   kCloud,
                                   kLidarServo,
                                   kSelfKeyframe,
                                   kNeighbourKeyframe,
                                   kNeighbourOdometry,
                                   kDetectedPoints,
                                   kDetected,
                                   kMissionDurationRemained,
                                   kClock,
                                   kBoundingBoxes,
                                   kCommandRejected,
                                   kHand,
                                   kActivity,
                                   kTrajectoryCommand,
                                   kGimbalCommand,
                                   kCameraTrigger,
                                   kTrigger,
                                   kOctomap,
                                   kFlightMap,
                                   kDiagnostics,
                                   kCapture,
                                   kCaptureStored};
  return kAll;
}

std::span<const TopicInfo> gcs_topics() {
  static constexpr std::array kAll{kBoundingBoxes,     kClock, kMissionDurationRemained,
                                   kNeighbourOdometry, kScore, kScoreEval};
  return kAll;
}

std::span<const TopicInfo> score_topics() {
  static constexpr std::array kAll{kScore, kScoreEval};
  return kAll;
}

std::span<const TopicInfo> viewer_topics() {
  static constexpr std::array kAll{kVizStructure, kVizBoxes,  kVizLinks, kVizFrusta, kVizFleet, kVizPaths,
                                   kVizMap,       kVizScored, kTf,       kTfStatic,  kClock};
  return kAll;
}

std::span<const TopicInfo> lockstep_topics() {
  static constexpr std::array kAll{kStep,   kDone,   kReady, kStationReady, kStationDone,  kResync,    kAttached,
                                   kRouted, kAwaits, kDrop,  kLedger,       kRadioRequest, kRadioReply};
  return kAll;
}

}  // namespace topics
}  // namespace skein
