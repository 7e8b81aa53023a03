#include "uav_agent/radio_node.hpp"

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "idl/type_names.hpp"

namespace skein::agent {

using Counterpart = bus::LockstepClient::Counterpart;

namespace {

constexpr std::string_view kTextType = "std_msgs/msg/String";

}  // namespace

RadioNode::RadioNode(const Scenario& scenario, Node node)
    : routes_(radio_routes(scenario)), node_(node), nodes_(scenario.fleet.size() + 1) {
  for (const RadioRoute& route : routes_) {
    if (route.ros_type == kTextType && route.source == node_) out_.insert(route.ros_topic);
  }
}

void RadioNode::declare(bus::LockstepClient& client, std::vector<RadioMessage>& received) const {
  std::set<std::string> declared;
  for (const RadioRoute& route : routes_) {
    if (route.source != node_ || !out_.contains(route.ros_topic) || !declared.insert(route.topic).second) continue;
    client.declare_writer(bus::spec({route.topic, route.type, false, topics::kRadioDepth}), Counterpart::router);
  }
  // All sources of a topic arrive on one: the receiver cannot tell them apart, as in CARIC.
  for (const RadioRoute& route : routes_) {
    for (const RadioTarget& target : route.targets) {
      if (target.node != node_ || route.ros_type != kTextType || !declared.insert(target.topic).second) continue;
      client.read<msg::String>(bus::spec({target.topic, route.type, false, topics::radio_depth(nodes_)}),
                               Counterpart::router, [&received, topic = route.ros_topic](const msg::String& m) {
                                 received.push_back({topic, m.data(), std::nullopt});
                               });
    }
  }
}

void RadioNode::send(bus::LockstepClient& client, std::span<const RadioMessage> messages) const {
  for (const RadioMessage& message : messages) {
    if (!out_.contains(message.topic)) continue;
    msg::String text;
    text.data(message.text);
    client.write(wire_topic(message.topic), text);
  }
}

}  // namespace skein::agent
