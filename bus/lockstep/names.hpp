// Member names of programs in the lock-step. The name of an agent is that of its UAV; the name of a user's program at
// the ground station is that of its radio node, "gcs".
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

/// Values of an order in a Step.
inline constexpr std::string_view kOrderKill = "kill";
inline constexpr std::string_view kOrderStop = "stop";

/// The TopicSpec, as a backend needs it, of a topic of the table (core/topics.hpp).
inline TopicSpec spec(const topics::WireTopic& topic) {
  return {topic.name, topic.type, Qos{.reliable = true, .latched = topic.latched, .depth = topic.depth}};
}

/// Topics on which a member sends Ready and Done. The station has topics of its own, because it may share its domain
/// with a user's program.
inline TopicSpec ready_spec(std::string_view member) {
  return spec(member == kStationName ? topics::station_ready() : topics::ready());
}
inline TopicSpec done_spec(std::string_view member) {
  return spec(member == kStationName ? topics::station_done() : topics::done());
}

}  // namespace skein::bus
