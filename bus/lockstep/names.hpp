// Names under which programs take part in the lock-step; a UAV's agent has the UAV's name, a user's program at the
// ground station that of its node, "gcs".
#pragma once

#include <string_view>

#include "bus/bus.hpp"
#include "core/topics.hpp"
#include "results/run_folder.hpp"

namespace skein::bus {

inline constexpr std::string_view kRouterName = programs::kCommRouter;
inline constexpr std::string_view kStationName = topics::kStationMember;
static_assert(kStationName == programs::kStation);
inline constexpr std::string_view kGcsName = "gcs";

/// Orders in a Step.
inline constexpr std::string_view kOrderKill = "kill";
inline constexpr std::string_view kOrderStop = "stop";

/// A topic of the one table (core/topics.hpp) as a backend takes it.
inline TopicSpec spec(const topics::WireTopic& topic) {
  return {topic.name, topic.type, Qos{.reliable = true, .latched = topic.latched, .depth = topic.depth}};
}

/// Where a member says ready and done: the station at doors of its own, since it may share its domain.
inline TopicSpec ready_spec(std::string_view member) {
  return spec(member == kStationName ? topics::station_ready() : topics::ready());
}
inline TopicSpec done_spec(std::string_view member) {
  return spec(member == kStationName ? topics::station_done() : topics::done());
}

}  // namespace skein::bus
