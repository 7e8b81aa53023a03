// Radio routes: for each radio topic, the nodes that may send on it and the nodes that receive it. A message that its
// source writes on "/x" arrives on "/x/<target>" in each target's domain, never at the source. Pure; any thread.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/topics.hpp"

namespace skein {

struct RadioTarget {
  Node node = kStationNode;
  std::string topic;  ///< DDS name in the target's domain: "rt/x/<target>"
};

/// One permitted source of one radio topic.
struct RadioRoute {
  Node source = kStationNode;
  std::string ros_topic;             ///< "/x"
  std::string ros_type;              ///< "std_msgs/msg/String"
  std::string topic;                 ///< DDS name in the source's domain: "rt/x"
  std::string type;                  ///< DDS type: "std_msgs::msg::dds_::String_"
  std::vector<RadioTarget> targets;  ///< ascending nodes (of each registration), without the source
  std::string member = {};           ///< the only program of the node that may send on it; empty: any program may
};

/// All routes of a scenario: first those that carry captures and their acknowledgements (they always exist: for each
/// UAV "/captures/<id>" to the station and "/captures_ack/<id>" back), then the declared topics in the scenario's
/// order, sources ascending, and last "/plan" from all to all, unless the scenario declares that topic itself. The
/// index in this list is the route's number in every process of a run.
/// @throws InputError, naming the scenario file and the key, for: a malformed topic or type; an unknown or repeated
///   node; no source or no target besides the source itself; one source declared twice for a topic; a topic with two
///   types; a name that is taken in a domain by another use (a standard topic that the source does not write itself,
///   or another topic's arrivals), or that the station uses to tell the score.
std::vector<RadioRoute> radio_routes(const Scenario& scenario);

/// A radio topic at one of its nodes.
struct NodeTopic {
  std::string ros_topic;  ///< "/x"
  std::string ros_type;   ///< "std_msgs/msg/String"
  std::string topic;      ///< DDS name in the node's domain: "rt/x" of a sent topic, "rt/x/<node>" of arrivals
  std::string type;       ///< DDS type
};

struct NodeTopics {
  std::vector<NodeTopic> sent;      ///< on which the node may send
  std::vector<NodeTopic> arriving;  ///< of which messages arrive, from any number of sources
};

/// The part of radio_routes() that concerns one node, in the same order. Its cost does not grow with the square of the
/// fleet. A topic that the scenario declares several times, with other sources, may appear as often.
/// @param scenario  of which radio_routes() accepts the topics.
NodeTopics node_topics(const Scenario& scenario, Node node);

/// The routes of a run. Nodes may add routes during the run (docs/radio.md). The table rejects names that are in use.
/// Routes keep their numbers; one that was closed has no targets. Not thread-safe.
class RadioTable {
 public:
  /// @param scenario  must outlive this. @throws InputError as radio_routes() does.
  explicit RadioTable(const Scenario& scenario);
  ~RadioTable();

  const std::vector<RadioRoute>& routes() const;
  /// Adds a route for messages of `source` on a topic. If there is one already, adds the targets that it lacks.
  /// @param targets  names of other nodes, or {"all"}
  /// @returns the route's number
  /// @throws InputError, and changes nothing, for: a malformed or reserved name; a malformed type, or another type than
  ///   the topic has; an unknown or repeated target, the source among them, or none; a name that is taken at
  ///   either end.
  std::size_t open(Node source, const std::string& ros_topic, const std::string& ros_type,
                   const std::vector<std::string>& targets);
  /// Closes a route that open() added and on which no message passed. Its names, and the topic's type unless another
  /// route has the topic, are free again. open() may open it again, under the same number.
  void close(std::size_t route);
  /// The target entry (node and DDS name) for a topic's arrivals at a node. The topic need not exist yet.
  /// @throws InputError for a malformed name or type, for another type than the topic has, and for a taken name.
  RadioTarget arrival(Node node, const std::string& ros_topic, const std::string& ros_type) const;

 private:
  class Builder;
  std::unique_ptr<Builder> builder_;
};

/// Name under which a radio topic arrives: ("/x", "jurong") -> "/x/jurong".
std::string arrival_topic(std::string_view ros_topic, std::string_view target);

/// Radio topic for messages between planners, and between them and the ground station: std_msgs/String.
/// It always exists.
inline constexpr std::string_view kPlanTopic = "/plan";

/// Radio topics of a UAV's captures (UAV to station) and of their acknowledgements (station to UAV): ROS names.
std::string captures_topic(std::string_view uav);
std::string captures_ack_topic(std::string_view uav);
inline constexpr std::string_view kCapturesType = "skein_msgs/msg/CaptureReports";
inline constexpr std::string_view kCapturesAckType = "skein_msgs/msg/CaptureAck";

/// DDS topics of custody (delivery of captures) at both ends, for the programs that write and read them.
namespace topics {
WireTopic captures(std::string_view uav);             ///< written in the UAV's domain
WireTopic captures_at_station(std::string_view uav);  ///< read in the GCS domain
WireTopic captures_ack(std::string_view uav);         ///< written in the GCS domain
WireTopic captures_ack_at_uav(std::string_view uav);  ///< read in the UAV's domain
}  // namespace topics

}  // namespace skein
