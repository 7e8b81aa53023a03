#include "core/radio_routes.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace skein {
namespace {

constexpr std::string_view kAll = "all";

/// What a wire topic in one node's domain is already used for.
struct Use {
  enum class Kind {
    standard,      ///< of the table in core/topics.hpp, not the node's own to send
    standard_own,  ///< of that table, but written by the node's own software
    sent,          ///< radio topic that the node sends
    arriving,      ///< arrivals of a radio topic
  };
  Kind kind;
  std::string ros_topic;  ///< whose arrivals
  std::string type;       ///< on the wire
};

/// Nodes that a list names, ascending.
struct NodeList {
  std::vector<Node> nodes;
  bool all = false;
};

/// Builds the table declaration by declaration; knows every name that is taken.
class RouteBuilder {
 public:
  explicit RouteBuilder(const Scenario& scenario) : scenario_(scenario), uses_(scenario.fleet.size() + 1) {
    for (Node node = 0; node < uses_.size(); ++node) {
      reserve(node, node == kStationNode ? topics::gcs_topics() : topics::uav_topics());
      reserve(node, topics::lockstep_topics());
    }
  }

  void declare(const RadioTopicConfig& declared, const std::string& where) {
    where_ = where;
    const std::string topic = checked("name", [&] { return wire_topic(declared.name); });
    const std::string type = checked("type", [&] { return wire_type(declared.type); });
    if (declared.name.starts_with("/skein/")) fail("name", "names under /skein/ are Skein's own; choose another");
    const auto [known, fresh] = types_.emplace(declared.name, declared.type);
    if (!fresh && known->second != declared.type) {
      fail("type", "'" + declared.name + "' was declared as " + known->second + " before; a topic has one type");
    }
    const NodeList sources = nodes("sources", declared.sources);
    const NodeList targets = nodes("targets", declared.targets);
    for (const Node source : sources.nodes) {
      RadioRoute route{source, declared.name, declared.type, topic, type, {}};
      for (const Node target : targets.nodes) {
        if (target == source) continue;  // a message never comes back to its source
        route.targets.push_back({target, wire_topic(arrival_topic(declared.name, name(target)))});
      }
      if (route.targets.empty()) {
        if (sources.all && sources.nodes.size() > 1) continue;  // "all" means: all that have somebody to talk to
        fail("targets", "'" + name(source) + "' has no target besides itself; name another node or 'all'");
      }
      occupy(route);
      routes_.push_back(std::move(route));
    }
  }

  std::vector<RadioRoute> take() { return std::move(routes_); }

 private:
  const std::string& name(Node node) const { return scenario_.node_name(node); }

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw InputError(scenario_.file.string() + ": " + where_ + "." + key + ": " + what);
  }

  template <class Work>
  std::string checked(const std::string& key, Work work) const {
    try {
      return work();
    } catch (const InputError& error) {
      fail(key, error.what());
    }
  }

  std::optional<Node> find_node(const std::string& wanted) const {
    for (Node node = 0; node < uses_.size(); ++node) {
      if (name(node) == wanted) return node;
    }
    return std::nullopt;
  }

  NodeList nodes(const std::string& key, const std::vector<std::string>& names) const {
    NodeList list;
    if (names.empty()) fail(key, "is empty; name at least one node, or 'all'");
    if (std::ranges::find(names, kAll) != names.end()) {
      if (names.size() > 1) fail(key, "'all' stands alone; leave the other names out");
      list.all = true;
      for (Node node = 0; node < uses_.size(); ++node) list.nodes.push_back(node);
      return list;
    }
    for (const std::string& wanted : names) {
      const std::optional<Node> node = find_node(wanted);
      if (!node) fail(key, "there is no node '" + wanted + "'; there are: " + node_names() + " and 'all'");
      if (std::ranges::find(list.nodes, *node) != list.nodes.end()) fail(key, "names '" + wanted + "' twice");
      list.nodes.push_back(*node);
    }
    std::ranges::sort(list.nodes);
    return list;
  }

  std::string node_names() const {
    std::string text;
    for (Node node = 0; node < uses_.size(); ++node) text += (node == 0 ? "" : ", ") + name(node);
    return text;
  }

  void reserve(Node node, std::span<const topics::TopicInfo> table) {
    for (const topics::TopicInfo& topic : table) {
      const bool own =
          topic.direction == topics::Direction::from_agent || topic.direction == topics::Direction::from_station;
      const topics::WireTopic wire = topics::wire(topic, name(node));
      const Use::Kind kind = own ? Use::Kind::standard_own : Use::Kind::standard;
      uses_[node].emplace(wire.name, Use{kind, std::string(topic.pattern), wire.type});
    }
  }

  /// Enters the names that a route uses in the domains of its source and its targets.
  void occupy(const RadioRoute& route) {
    const auto [at_source, fresh] =
        uses_[route.source].emplace(route.topic, Use{Use::Kind::sent, route.ros_topic, route.type});
    if (!fresh) {
      Use& taken = at_source->second;
      if (taken.kind == Use::Kind::sent) {
        fail("sources", "'" + name(route.source) + "' was declared as a source of " + route.ros_topic + " before");
      }
      if (taken.kind != Use::Kind::standard_own || taken.type != route.type) {
        refuse(route.ros_topic, route.source, taken);
      }
      taken.kind = Use::Kind::sent;
    }
    for (const RadioTarget& target : route.targets) {
      const Use use{Use::Kind::arriving, route.ros_topic, route.type};
      const auto [at_target, unused] = uses_[target.node].emplace(target.topic, use);
      const Use& taken = at_target->second;
      const bool same_topic = taken.kind == Use::Kind::arriving && taken.ros_topic == route.ros_topic;
      if (!unused && !same_topic) refuse(arrival_topic(route.ros_topic, name(target.node)), target.node, taken);
    }
  }

  [[noreturn]] void refuse(const std::string& ros_name, Node node, const Use& taken) const {
    std::string by;
    switch (taken.kind) {
      case Use::Kind::standard:
        by = "a topic that Skein writes";
        break;
      case Use::Kind::standard_own:
        by = "a standard topic of type " + taken.type;
        break;
      case Use::Kind::sent:
        by = "a radio topic that '" + name(node) + "' sends";
        break;
      case Use::Kind::arriving:
        by = "what arrives of " + taken.ros_topic;
        break;
    }
    fail("name", "at '" + name(node) + "' the name " + ros_name + " is taken by " + by + "; choose another");
  }

  const Scenario& scenario_;
  std::string where_;
  std::map<std::string, std::string> types_;      ///< ROS topic to ROS type
  std::vector<std::map<std::string, Use>> uses_;  ///< by node: wire topic to its use
  std::vector<RadioRoute> routes_;
};

}  // namespace

std::vector<RadioRoute> radio_routes(const Scenario& scenario) {
  RouteBuilder builder(scenario);
  const std::string& station = scenario.node_name(kStationNode);
  for (const UavConfig& uav : scenario.fleet) {
    builder.declare({captures_topic(uav.name), std::string(kCapturesType), {uav.name}, {station}}, "radio");
    builder.declare({captures_ack_topic(uav.name), std::string(kCapturesAckType), {station}, {uav.name}}, "radio");
  }
  for (std::size_t i = 0; i < scenario.radio.size(); ++i) {
    builder.declare(scenario.radio[i], "radio.topics[" + std::to_string(i) + "]");
  }
  return builder.take();
}

std::string arrival_topic(std::string_view ros_topic, std::string_view target) {
  return std::string(ros_topic) + "/" + std::string(target);
}

std::string captures_topic(std::string_view uav) { return "/captures/" + std::string(uav); }
std::string captures_ack_topic(std::string_view uav) { return "/captures_ack/" + std::string(uav); }

namespace topics {
namespace {

WireTopic radio(const std::string& ros_topic, std::string_view ros_type) {
  return {wire_topic(ros_topic), wire_type(ros_type), false, kRadioDepth};
}

}  // namespace

WireTopic captures(std::string_view uav) { return radio(captures_topic(uav), kCapturesType); }
WireTopic captures_at_station(std::string_view uav) {
  return radio(arrival_topic(captures_topic(uav), "gcs"), kCapturesType);
}
WireTopic captures_ack(std::string_view uav) { return radio(captures_ack_topic(uav), kCapturesAckType); }
WireTopic captures_ack_at_uav(std::string_view uav) {
  return radio(arrival_topic(captures_ack_topic(uav), uav), kCapturesAckType);
}

}  // namespace topics
}  // namespace skein
