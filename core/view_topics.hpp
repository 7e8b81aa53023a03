// What sim_server and the station say to each other in the world's domain about a run that is watched (docs/view.md):
// only then are there such topics. Nobody else reads or writes them, and they are in no count of the lock-step. Each
// sample is a JSON object as text. And what a UAV shows of its map and itself, in its own domain.   Pure; any thread.
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
inline constexpr TopicInfo kViewOrders{"/skein/view/orders", "std_msgs/msg/String", Direction::internal, 64,
                                       "station -> server: what browsers ask of the run"};

inline constexpr TopicInfo kViewCloud{
    "/skein/view/cloud", "std_msgs/msg/String", Direction::internal, 16,
    "server -> station: points or maps that a browser asked for; the newest is enough"};

/// What a UAV flies on, as the octomap is told (kOctomap). Read for a page while somebody there looks at it.
inline constexpr TopicInfo kFlightMap{"/{id}/flight_map",
                                      "octomap_msgs/msg/Octomap",
                                      Direction::shown_by_agent,
                                      1,
                                      "when it has grown, 1 Hz at most; latched",
                                      true};

/// What the on-board software knows of itself, for ROS 2's diagnostics tools (uav_agent/diagnostics.hpp).
inline constexpr TopicInfo kDiagnostics{"/diagnostics", "diagnostic_msgs/msg/DiagnosticArray",
                                        Direction::shown_by_agent, kStateDepth, "1 Hz"};

inline WireTopic view_story() { return wire(kViewStory); }
inline WireTopic view_state() { return wire(kViewState); }
inline WireTopic view_cloud() { return wire(kViewCloud); }
inline WireTopic flight_map(std::string_view id) { return wire(kFlightMap, id); }
inline WireTopic diagnostics() { return wire(kDiagnostics); }
inline WireTopic view_orders() { return wire(kViewOrders); }

}  // namespace skein::topics
