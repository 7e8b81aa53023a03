// What of a run is recorded: the one place that knows which topics, how often. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/types.hpp"

namespace skein::recording {

/// How much (`--record`).
enum class Scope {
  none,
  messages,  ///< radio messages as sent, their arrivals, and what programs tell of themselves
  run,       ///< what a run is made of: poses, commands, captures, radio messages as sent, tally, events
  all,       ///< and every sample that somebody in the fleet reads, and the score point by point
  clouds,    ///< and LiDAR clouds that nobody reads, which are otherwise not even made
};

/// "none", "messages", "run", "all" or "clouds". @throws InputError for anything else.
Scope scope_of(std::string_view name);

/// How a topic is recorded.
struct Choice {
  Tick period = 0;           ///< a sample in so much time at most; 0: every one
  bool also_unread = false;  ///< samples that nobody else reads, too
};

/// @param topic  ROS name in the domain of `node`. @returns nullopt: not at all.
std::optional<Choice> choice_of(Scope scope, std::string_view node, std::string_view topic);

/// "rt/x" -> "/x".
std::string ros_topic(std::string_view wire_name);

/// The name that tells one domain's topic from another's: "/jurong/clock" for "/clock" in jurong's domain.
/// @param node  "" for the world's domain.
std::string recorded_topic(std::string_view node, std::string_view topic);

}  // namespace skein::recording
