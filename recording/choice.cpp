#include "recording/choice.hpp"

#include <algorithm>
#include <initializer_list>

#include "core/topics.hpp"

namespace skein::recording {
namespace {

/// Recording period of odometry and similar topics. Twice a second is enough: the recording has all poses five times a
/// second in /tf, and a flight that repeats the recorded commands reproduces what each UAV received in each exchange.
constexpr double kPosePeriod_s = 0.5;

bool is(const topics::TopicInfo& info, std::string_view node, std::string_view topic) {
  return topics::wire(info, node).name == wire_topic(topic);
}

bool is_one_of(std::initializer_list<topics::TopicInfo> infos, std::string_view node, std::string_view topic) {
  return std::ranges::any_of(infos, [&](const topics::TopicInfo& info) { return is(info, node, topic); });
}

}  // namespace

Scope scope_of(std::string_view name) {
  if (name == "none") return Scope::none;
  if (name == "messages") return Scope::messages;
  if (name == "run") return Scope::run;
  if (name == "all") return Scope::all;
  if (name == "clouds") return Scope::clouds;
  throw InputError("--record " + std::string(name) + ": it must be none, messages, run, all or clouds");
}

std::optional<Choice> choice_of(Scope scope, std::string_view node, std::string_view topic) {
  using namespace topics;
  if (scope == Scope::none) return std::nullopt;
  const bool is_debug_value = !debug_name(wire_topic(topic), node).empty();
  if (scope == Scope::messages) return is_debug_value ? std::optional(Choice{0, true}) : std::nullopt;
  if (is_one_of({kOdometry, kGimbal, kBattery, kWind, kRadioLinks}, node, topic))
    return Choice{ticks(kPosePeriod_s), true};
  if (is_one_of({kTrajectoryCommand, kGimbalCommand, kCameraTrigger, kTrigger, kCommandRejected, kCapture,
                 kCaptureStored, kActivity, kHand},
                node, topic)) {
    return Choice{0, true};
  }
  if (is_debug_value) return Choice{0, true};
  if (is(kBoundingBoxes, node, topic)) return node == "gcs" ? std::optional(Choice{0, true}) : std::nullopt;
  if (scope == Scope::run) return std::nullopt;
  if (is(kScore, node, topic)) return Choice{0, true};  // unread samples, too: no program of a fleet reads this topic
  // The angle of the LiDAR's servo is recorded whenever clouds are: without it, a cloud does not show which way the
  // LiDAR was turned.
  const bool belongs_to_clouds = is_one_of({kCloud, kLidarServo, kSelfKeyframe, kNeighbourKeyframe}, node, topic);
  return Choice{0, belongs_to_clouds && scope == Scope::clouds};
}

std::string ros_topic(std::string_view wire_name) {
  return wire_name.starts_with("rt/") ? std::string(wire_name.substr(2)) : "/" + std::string(wire_name);
}

std::string recorded_topic(std::string_view node, std::string_view topic) {
  const std::string prefix = "/" + std::string(node);
  if (node.empty() || topic.starts_with(prefix + "/")) return std::string(topic);
  return prefix + std::string(topic);
}

}  // namespace skein::recording
