// Radio routes: which topic may go from which node to which others. A message on "/x" at its source arrives as
// "/x/<target>" in each target's domain; it never comes back to its source. Pure; safe from any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/scenario.hpp"
#include "core/topics.hpp"

namespace skein {

struct RadioTarget {
  Node node = kStationNode;
  std::string topic;  ///< on the wire of the target's domain: "rt/x/<target>"
};

/// One permitted source of one radio topic.
struct RadioRoute {
  Node source = kStationNode;
  std::string ros_topic;             ///< "/x"
  std::string ros_type;              ///< "std_msgs/msg/String"
  std::string topic;                 ///< on the wire of the source's domain: "rt/x"
  std::string type;                  ///< on the wire: "std_msgs::msg::dds_::String_"
  std::vector<RadioTarget> targets;  ///< ascending nodes, without the source
};

/// All routes of a scenario: first those that carry captures and their acknowledgements (always there: for each UAV
/// "/captures/<id>" to the station and "/captures_ack/<id>" back), then the declared topics in the scenario's order,
/// sources ascending. The index in this list is the route's number in every process of a run.
/// @throws InputError, naming the scenario file and the key, for: a malformed topic or type; an unknown or repeated
///   node; no source or no target besides the source itself; one source declared twice for a topic; a topic with two
///   types; a name that is taken in a domain by another use (a standard topic that the source does not write itself,
///   or another topic's arrivals).
std::vector<RadioRoute> radio_routes(const Scenario& scenario);

/// Name under which a radio topic arrives: ("/x", "jurong") -> "/x/jurong".
std::string arrival_topic(std::string_view ros_topic, std::string_view target);

/// Radio topics of a UAV's captures (UAV to station) and of their acknowledgements (station to UAV): ROS names.
std::string captures_topic(std::string_view uav);
std::string captures_ack_topic(std::string_view uav);
inline constexpr std::string_view kCapturesType = "skein_msgs/msg/CaptureReports";
inline constexpr std::string_view kCapturesAckType = "skein_msgs/msg/CaptureAck";

/// Wire topics of custody at both ends, for the programs that write and read them.
namespace topics {
WireTopic captures(std::string_view uav);             ///< written in the UAV's domain
WireTopic captures_at_station(std::string_view uav);  ///< read in the GCS domain
WireTopic captures_ack(std::string_view uav);         ///< written in the GCS domain
WireTopic captures_ack_at_uav(std::string_view uav);  ///< read in the UAV's domain
}  // namespace topics

}  // namespace skein
