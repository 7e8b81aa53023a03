// Topics of the live view (docs/view.md). kView...: messages between sim_server and the station in the world domain,
// only in a run that is watched; no other program uses them. Each sample is a JSON object as text. The other topics:
// map and diagnostics of a UAV, in the UAV's own domain. The lock-step counts none of these samples.   Pure; any
// thread.
#pragma once

#include "core/topics.hpp"

namespace skein::topics {

/// The scene first, then lines (view/story.hpp). Latched with a large depth, so that a station that starts late, or
/// restarts, receives all of it.
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

/// The map on which a UAV flies (world map, or else map of key frames), in the format of kOctomap. sim_server reads it
/// only while a viewer of the web page displays it.
inline constexpr TopicInfo kFlightMap{"/{id}/flight_map",
                                      "octomap_msgs/msg/Octomap",
                                      Direction::shown_by_agent,
                                      1,
                                      "when it has grown, 1 Hz at most; latched",
                                      true};

/// Status of the on-board software, for ROS 2's diagnostics tools (uav_agent/diagnostics.hpp).
inline constexpr TopicInfo kDiagnostics{"/diagnostics", "diagnostic_msgs/msg/DiagnosticArray",
                                        Direction::shown_by_agent, kStateDepth, "1 Hz"};

inline WireTopic view_story() { return wire(kViewStory); }
inline WireTopic view_state() { return wire(kViewState); }
inline WireTopic view_cloud() { return wire(kViewCloud); }
inline WireTopic flight_map(std::string_view id) { return wire(kFlightMap, id); }
inline WireTopic diagnostics() { return wire(kDiagnostics); }
inline WireTopic view_orders() { return wire(kViewOrders); }

}  // namespace skein::topics
