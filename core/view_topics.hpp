// What sim_server and the station say to each other in the world's domain about a run that is watched (docs/view.md):
// only then are there such topics. Nobody else reads or writes them, and they are in no count of the lock-step. Each
// sample is a JSON object as text.   Pure; any thread.
#pragma once

#include "core/topics.hpp"

namespace skein::topics {

/// The scene first, then lines (view/story.hpp). Latched and deep: a station that starts late or again gets all.
inline constexpr TopicInfo kViewStory{"/skein/view/story",
                                      "std_msgs/msg/String",
                                      Direction::internal,
                                      100000,
                                      "server -> station: what a page has to be told",
                                      true};
inline constexpr TopicInfo kViewState{"/skein/view/state", "std_msgs/msg/String", Direction::internal, 1,
                                      "server -> station: how it stands; the newest is enough"};
inline constexpr TopicInfo kViewTime{"/skein/view/time", "std_msgs/msg/String", Direction::internal, 64,
                                     "station -> server: pause, one step, speed"};

inline WireTopic view_story() { return wire(kViewStory); }
inline WireTopic view_state() { return wire(kViewState); }
inline WireTopic view_time() { return wire(kViewTime); }

}  // namespace skein::topics
