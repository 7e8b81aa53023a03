#include "idl/activity_conversions.hpp"

#include <algorithm>
#include <cmath>

#include "core/text/utf8.hpp"
#include "idl/conversions.hpp"

namespace skein {
namespace {

constexpr std::size_t kLongestText = 160;

/// Valid UTF-8, cut off between two characters.
std::string cell_of(const std::string& whole) {
  std::string text = as_utf8(first_bytes(whole, kLongestText));
  std::ranges::replace(text, ',', ';');
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return text;
}

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

}  // namespace

msg::Activity to_activity(Tick tick, const Activity& activity) {
  msg::Activity message;
  message.header(to_header(tick));
  message.mode(activity.mode);
  message.has_goal(activity.goal_W.has_value());
  if (activity.goal_W) message.goal(to_point(*activity.goal_W));
  message.waits_for(activity.waits_for);
  message.no_way(activity.no_way);
  message.speed(activity.speed_mps);
  message.undelivered(activity.undelivered);
  message.cpu_s(activity.cpu_s);
  return message;
}

Activity from_activity(const msg::Activity& message) {
  Activity activity{.mode = cell_of(message.mode()),
                    .waits_for = cell_of(message.waits_for()),
                    .no_way = cell_of(message.no_way()),
                    .speed_mps = finite_or_zero(message.speed()),
                    .undelivered = message.undelivered(),
                    .cpu_s = finite_or_zero(message.cpu_s())};
  const Vector3d goal_W(message.goal().x(), message.goal().y(), message.goal().z());
  if (message.has_goal() && goal_W.allFinite()) activity.goal_W = goal_W;
  return activity;
}

}  // namespace skein
