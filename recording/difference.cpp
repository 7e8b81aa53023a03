#include "recording/difference.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "idl/cdr.hpp"
#include "idl/type_names.hpp"

namespace skein::recording {
namespace {

constexpr std::size_t kLongestText = 160;

std::string text_of_vector(const auto& v) { return fmt::format("({}, {}, {})", v.x(), v.y(), v.z()); }

std::string text_of(const msg::Twist& twist) {
  return "linear " + text_of_vector(twist.linear()) + " angular " + text_of_vector(twist.angular());
}

std::string text_of(const msg::MultiDOFJointTrajectory& trajectory) {
  if (trajectory.points().empty()) return "no point";
  const auto& point = trajectory.points().front();
  std::string text;
  for (const auto& transform : point.transforms()) {
    const auto& q = transform.rotation();
    text += fmt::format("position {} attitude ({}, {}, {}, {})", text_of_vector(transform.translation()), q.w(), q.x(),
                        q.y(), q.z());
  }
  for (const auto& velocity : point.velocities()) text += " velocity: " + text_of(velocity);
  for (const auto& acceleration : point.accelerations()) text += " acceleration: " + text_of(acceleration);
  return text;
}

std::string text_of(const msg::String& string) {
  const std::string& text = string.data();
  const auto is_plain = [](unsigned char c) { return c >= 0x20 && c < 0x7F; };
  if (!std::ranges::all_of(text, is_plain)) return "";  // planners also put binary data into strings
  return text.size() <= kLongestText ? "'" + text + "'" : fmt::format("'{}'...", text.substr(0, kLongestText));
}

std::string text_of(const msg::BoolStamped& trigger) { return trigger.data() ? "true" : "false"; }

/// @returns an empty string if the payload has another type or cannot be decoded.
template <class Message>
std::string text_if(const std::string& wire_type, mcap::ByteView payload) {
  Message message;
  return wire_type == type_name<Message>() && decode(payload, message) ? text_of(message) : "";
}

}  // namespace

std::string describe(const std::string& wire_type, mcap::ByteView payload) {
  for (const auto& text :
       {text_if<msg::MultiDOFJointTrajectory>(wire_type, payload), text_if<msg::Twist>(wire_type, payload),
        text_if<msg::BoolStamped>(wire_type, payload), text_if<msg::String>(wire_type, payload)}) {
    if (!text.empty()) return text;
  }
  return fmt::format("{} bytes with checksum {:08x}", payload.size(), mcap::crc_of(payload));
}

std::optional<std::pair<std::string, std::string>> first_difference(const std::string& wire_type,
                                                                    std::span<const mcap::Bytes> recorded,
                                                                    std::span<const mcap::Bytes> now) {
  const auto [a, b] = std::ranges::mismatch(recorded, now);
  if (a == recorded.end() && b == now.end()) return std::nullopt;
  const auto say = [&](auto position, auto end) {
    return position == end ? std::string("nothing") : describe(wire_type, *position);
  };
  return std::pair(say(a, recorded.end()), say(b, now.end()));
}

std::string text_of(const Difference& difference) {
  return fmt::format("{} first differs at {:.2f} s on {}: it was {}, and is {}", difference.node,
                     seconds(difference.tick), difference.topic, difference.recorded, difference.now);
}

}  // namespace skein::recording
