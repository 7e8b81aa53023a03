// Defines which topics of a run are recorded, and how often. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/types.hpp"

namespace skein::recording {

/// How much is recorded (`--record`).
enum class Scope {
  none,
  messages,  ///< radio messages as sent, their arrivals, and the debug values of programs
  run,     ///< the essentials of a run: poses, commands, captures, radio messages as sent, debug values, tally, events
  all,     ///< in addition every sample that a program of the fleet reads, and the score of each point
  clouds,  ///< in addition LiDAR clouds that no program reads, which otherwise are not even generated
};

/// "none", "messages", "run", "all" or "clouds". @throws InputError for anything else.
Scope scope_of(std::string_view name);

/// How a topic is recorded.
struct Choice {
  Tick period = 0;           ///< least time between two recorded samples; 0: every sample
  bool also_unread = false;  ///< also samples that no program reads
};

/// How a topic is recorded. @param node  of the topic's domain: a UAV's name, "gcs", or "" for the world's.
/// @param topic  ROS name in this domain. @returns nullopt: the topic is not recorded.
std::optional<Choice> choice_of(Scope scope, std::string_view node, std::string_view topic);

/// The ROS name of a DDS topic: "rt/x" -> "/x".
std::string ros_topic(std::string_view wire_name);

/// The name of a topic in the recording, unique over all domains: "/jurong/clock" for "/clock" in jurong's domain.
/// @param node  "" for the world's domain.
std::string recorded_topic(std::string_view node, std::string_view topic);

}  // namespace skein::recording
