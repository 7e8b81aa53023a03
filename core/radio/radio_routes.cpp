#include "core/radio/radio_routes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

namespace skein {
namespace {

constexpr std::string_view kAll = "all";

/// The use that a wire topic already has in one node's domain.
struct Use {
  enum class Kind {
    standard,      ///< topic of the table in core/topics.hpp that the node must not send
    standard_own,  ///< topic of that table that the node's own software writes
    sent,          ///< radio topic that the node sends
    arriving,      ///< arrivals of a radio topic
  };
  Kind kind;
  std::string ros_topic;  ///< also of `arriving`: the topic on which its messages are sent
  std::string type;       ///< on the wire
};

/// The nodes that a list names, in ascending order.
struct NodeList {
  std::vector<Node> nodes;
  bool all = false;
};

/// The topics of a UAV's captures and of their acknowledgements.
std::array<RadioTopicConfig, 2> custody_topics(const Scenario& scenario, const std::string& uav) {
  const std::string& station = scenario.node_name(kStationNode);
  return {RadioTopicConfig{captures_topic(uav), std::string(kCapturesType), {uav}, {station}},
          RadioTopicConfig{captures_ack_topic(uav), std::string(kCapturesAckType), {station}, {uav}}};
}

/// The topic "/plan" unless the scenario declares one itself.
std::optional<RadioTopicConfig> plan_topic(const Scenario& scenario) {
  const bool own = std::ranges::any_of(scenario.radio, [](const auto& topic) { return topic.name == kPlanTopic; });
  if (own || scenario.fleet.empty()) return std::nullopt;
  const std::vector<std::string> all{std::string(kAll)};
  return RadioTopicConfig{std::string(kPlanTopic), "std_msgs/msg/String", all, all};
}

}  // namespace

/// Builds the table declaration by declaration.
class RadioTable::Builder {
 public:
  explicit Builder(const Scenario& scenario) : scenario_(scenario), uses_(scenario.fleet.size() + 1) {
    for (const Node node : scenario_.nodes()) {
      if (name(node).size() > longest_name_.size()) longest_name_ = name(node);
      reserve(node, node == kStationNode ? topics::gcs_topics() : topics::uav_topics());
      reserve(node, topics::lockstep_topics());
      reserve(node, topics::score_topics());
    }
    reserved_ = uses_;
  }

  /// @param member  the only program that may send on the topic; empty: any program of a source
  void declare(const RadioTopicConfig& declared, const std::string& where, std::string_view member = {}) {
    where_ = scenario_.file.string() + ": " + where + ".";
    const RadioRoute checked = check_names(declared.name, declared.type);
    types_.emplace(declared.name, declared.type);
    const NodeList sources = nodes("sources", declared.sources);
    const NodeList targets = nodes("targets", declared.targets);
    for (const Node source : sources.nodes) {
      RadioRoute route = checked;
      route.source = source;
      route.member = member;
      add_targets(route, targets);
      if (route.targets.empty()) {
        if (sources.all && sources.nodes.size() > 1) continue;  // "all" means: all that have a target
        fail("targets", "'" + name(source) + "' has no target besides itself; name another node or 'all'");
      }
      occupy_source(route);
      occupy_targets(route);
      routes_.push_back(std::move(route));
    }
  }

  std::size_t open(Node source, const std::string& ros_topic, const std::string& ros_type,
                   const std::vector<std::string>& wanted) {
    const auto types = types_;
    const auto uses = uses_;
    try {
      return add_route(source, ros_topic, ros_type, wanted);
    } catch (const InputError&) {
      types_ = types;
      uses_ = uses;
      throw;
    }
  }

  void close(std::size_t number) {
    RadioRoute& route = routes_[number];
    release(route.source, route.topic);
    const std::vector<RadioTarget> closed = std::exchange(route.targets, {});
    // Only messages of the same topic arrive under the same name (check_arrival()).
    bool others_send = false;
    std::vector<bool> arrives_still(uses_.size());  // by node
    for (const RadioRoute& other : routes_) {
      if (other.ros_topic != route.ros_topic) continue;
      others_send = others_send || !other.targets.empty();
      for (const RadioTarget& target : other.targets) arrives_still[target.node] = true;
    }
    for (const RadioTarget& target : closed) {
      if (!arrives_still[target.node]) release(target.node, target.topic);
    }
    if (!others_send) types_.erase(route.ros_topic);
  }

  RadioTarget arrival(Node node, const std::string& ros_topic, const std::string& ros_type) {
    where_.clear();
    check_names(ros_topic, ros_type);
    RadioTarget target{node, wire_topic(arrival_topic(ros_topic, name(node)))};
    if (const auto taken = uses_[node].find(target.topic); taken != uses_[node].end()) {
      check_arrival(ros_topic, target, taken->second);
    }
    return target;
  }

  const std::vector<RadioRoute>& routes() const { return routes_; }

 private:
  const std::string& name(Node node) const { return scenario_.node_name(node); }

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw InputError(where_ + key + ": " + what);
  }

  std::string checked(const std::string& key, auto work) const {
    try {
      return work();
    } catch (const InputError& error) {
      fail(key, error.what());
    }
  }

  std::optional<Node> find_node(const std::string& wanted) const {
    for (const Node node : scenario_.nodes()) {
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
      for (const Node node : scenario_.nodes()) list.nodes.push_back(node);
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
    for (const Node node : scenario_.nodes()) text += (node == 0 ? "" : ", ") + name(node);
    return text;
  }

  void reserve(Node node, std::span<const topics::TopicInfo> table) {
    for (const topics::TopicInfo& topic : table) {
      const topics::WireTopic wire = topics::wire(topic, name(node));
      const bool own =
          topic.direction == topics::Direction::from_agent || topic.direction == topics::Direction::shown_by_agent;
      const Use::Kind kind = own ? Use::Kind::standard_own : Use::Kind::standard;
      uses_[node].emplace(wire.name, Use{kind, std::string(topic.pattern), wire.type});
    }
  }

  /// A route of this name and type, without its ends.
  RadioRoute check_names(const std::string& ros_topic, const std::string& ros_type) const {
    const std::string topic = checked("name", [&] { return wire_topic(ros_topic); });
    // Names of nodes are words, so only the length of a topic with the longest of them can be wrong.
    checked("name", [&] { return wire_topic(arrival_topic(ros_topic, longest_name_)); });
    const std::string type = checked("type", [&] { return wire_type(ros_type); });
    if (ros_topic.starts_with("/skein/")) fail("name", "names under /skein/ are Skein's own; choose another");
    // No node may send or receive the score by radio: it would tell UAVs which points they have not seen, and the
    // numbers of all points.
    if (std::ranges::find(topics::score_topics(), ros_topic, &topics::TopicInfo::pattern) !=
        topics::score_topics().end()) {
      fail("name", "'" + ros_topic + "' is the station's own and never goes on the radio; choose another");
    }
    const auto known = types_.find(ros_topic);
    if (known != types_.end() && known->second != ros_type) {
      fail("type", "'" + ros_topic + "' was declared as " + known->second + " before; a topic has one type");
    }
    return {kStationNode, ros_topic, ros_type, topic, type, {}};
  }

  /// Adds the targets of `wanted` that the route lacks, except its source: a message never comes back to its source.
  void add_targets(RadioRoute& route, const NodeList& wanted) const {
    const bool is_new = route.targets.empty();  // the list names no node twice
    for (const Node target : wanted.nodes) {
      const bool known = !is_new && std::ranges::find(route.targets, target, &RadioTarget::node) != route.targets.end();
      if (known || target == route.source) continue;
      route.targets.push_back({target, wire_topic(arrival_topic(route.ros_topic, name(target)))});
    }
  }

  std::size_t add_route(Node source, const std::string& ros_topic, const std::string& ros_type,
                        const std::vector<std::string>& wanted) {
    where_.clear();
    RadioRoute route = check_names(ros_topic, ros_type);
    if (ros_topic.starts_with("/captures/") || ros_topic.starts_with("/captures_ack/")) {
      fail("name", "names under /captures/ and /captures_ack/ carry the score; choose another");
    }
    const NodeList targets = nodes("targets", wanted);
    if (!targets.all && std::ranges::find(targets.nodes, source) != targets.nodes.end()) {
      fail("targets", "'" + name(source) + "' is the source itself; a message never comes back to it");
    }
    const auto same = [&](const RadioRoute& r) { return r.source == source && r.ros_topic == ros_topic; };
    const auto known = std::ranges::find_if(routes_, same);
    const bool is_open = known != routes_.end() && !known->targets.empty();
    if (is_open) route = *known;
    route.source = source;
    add_targets(route, targets);
    if (route.targets.empty()) fail("targets", "there is no other node than '" + name(source) + "'");
    if (!is_open) occupy_source(route);
    occupy_targets(route);
    types_.emplace(ros_topic, ros_type);
    const auto number = static_cast<std::size_t>(known - routes_.begin());
    if (known == routes_.end()) routes_.emplace_back();
    routes_[number] = std::move(route);
    return number;
  }

  /// Frees a name for other uses, except those of Skein's own topics.
  void release(Node node, const std::string& topic) {
    uses_[node].erase(topic);
    if (const auto own = reserved_[node].find(topic); own != reserved_[node].end()) uses_[node].insert(*own);
  }

  /// Enters the name that a route uses in the domain of its source.
  void occupy_source(const RadioRoute& route) {
    const auto [at_source, fresh] =
        uses_[route.source].emplace(route.topic, Use{Use::Kind::sent, route.ros_topic, route.type});
    if (fresh) return;
    Use& taken = at_source->second;
    if (taken.kind == Use::Kind::sent) {
      fail("sources", "'" + name(route.source) + "' was declared as a source of " + route.ros_topic + " before");
    }
    if (taken.kind != Use::Kind::standard_own || taken.type != route.type) {
      refuse(route.ros_topic, route.source, taken);
    }
    taken.kind = Use::Kind::sent;
  }

  /// Enters the names that a route uses in the domains of its targets.
  void occupy_targets(const RadioRoute& route) {
    for (const RadioTarget& target : route.targets) {
      const Use use{Use::Kind::arriving, route.ros_topic, route.type};
      const auto [at_target, fresh] = uses_[target.node].emplace(target.topic, use);
      if (!fresh) check_arrival(route.ros_topic, target, at_target->second);
    }
  }

  void check_arrival(const std::string& ros_topic, const RadioTarget& target, const Use& taken) const {
    if (taken.kind == Use::Kind::arriving && taken.ros_topic == ros_topic) return;
    refuse(arrival_topic(ros_topic, name(target.node)), target.node, taken);
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
  std::string longest_name_;                          ///< of a node
  std::string where_;                                 ///< prefix of messages: the file and key that are being read
  std::map<std::string, std::string> types_;          ///< ROS topic to ROS type
  std::vector<std::map<std::string, Use>> uses_;      ///< by node: wire topic to its use
  std::vector<std::map<std::string, Use>> reserved_;  ///< likewise, of the standard topics alone
  std::vector<RadioRoute> routes_;
};

RadioTable::RadioTable(const Scenario& scenario) : builder_(std::make_unique<Builder>(scenario)) {
  for (const UavConfig& uav : scenario.fleet) {
    for (const RadioTopicConfig& topic : custody_topics(scenario, uav.name)) {
      const bool from_station = topic.sources.front() == scenario.node_name(kStationNode);
      builder_->declare(topic, "radio", from_station ? topics::kStationMember : std::string_view());
    }
  }
  for (std::size_t i = 0; i < scenario.radio.size(); ++i) {
    builder_->declare(scenario.radio[i], "radio.topics[" + std::to_string(i) + "]");
  }
  if (const auto plan = plan_topic(scenario)) builder_->declare(*plan, "radio");
}

RadioTable::~RadioTable() = default;

const std::vector<RadioRoute>& RadioTable::routes() const { return builder_->routes(); }

std::size_t RadioTable::open(Node source, const std::string& ros_topic, const std::string& ros_type,
                             const std::vector<std::string>& targets) {
  return builder_->open(source, ros_topic, ros_type, targets);
}

void RadioTable::close(std::size_t route) { builder_->close(route); }

RadioTarget RadioTable::arrival(Node node, const std::string& ros_topic, const std::string& ros_type) const {
  return builder_->arrival(node, ros_topic, ros_type);
}

std::vector<RadioRoute> radio_routes(const Scenario& scenario) { return RadioTable(scenario).routes(); }

NodeTopics node_topics(const Scenario& scenario, Node node) {
  NodeTopics found;
  const std::string& own = scenario.node_name(node);
  const auto names_other = [&](const std::vector<std::string>& nodes) {
    const bool all = nodes.front() == kAll && !scenario.fleet.empty();
    return all || std::ranges::any_of(nodes, [&](const std::string& name) { return name != kAll && name != own; });
  };
  const auto names_own = [&](const std::vector<std::string>& nodes) {
    return nodes.front() == kAll || std::ranges::find(nodes, own) != nodes.end();
  };
  const auto add = [&](const RadioTopicConfig& topic) {
    const std::string type = wire_type(topic.type);
    if (names_own(topic.sources) && names_other(topic.targets)) {
      found.sent.push_back({topic.name, topic.type, wire_topic(topic.name), type});
    }
    if (names_own(topic.targets) && names_other(topic.sources)) {
      found.arriving.push_back({topic.name, topic.type, wire_topic(arrival_topic(topic.name, own)), type});
    }
  };
  for (const UavConfig& uav : scenario.fleet) {
    if (node != kStationNode && uav.name != own) continue;
    for (const RadioTopicConfig& topic : custody_topics(scenario, uav.name)) add(topic);
  }
  for (const RadioTopicConfig& topic : scenario.radio) add(topic);
  if (const auto plan = plan_topic(scenario)) add(*plan);
  return found;
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
