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
    : node_topics_(node_topics(scenario, node)), nodes_(scenario.fleet.size() + 1) {
  for (std::vector<NodeTopic>* list : {&node_topics_.sent, &node_topics_.arriving}) {
    std::erase_if(*list, [](const NodeTopic& topic) { return topic.ros_type != kTextType; });
  }
  for (const NodeTopic& topic : node_topics_.sent) out_.insert(topic.ros_topic);
}

void RadioNode::declare(bus::LockstepClient& client, std::vector<RadioMessage>& received) const {
  std::set<std::string> declared;
  for (const NodeTopic& sent : node_topics_.sent) {
    if (!declared.insert(sent.topic).second) continue;
    client.declare_writer(bus::spec({sent.topic, sent.type, false, topics::kRadioDepth}), Counterpart::router);
  }
  // The messages of all sources arrive on one DDS topic, so the receiver cannot tell the sources apart, as in CARIC.
  for (const NodeTopic& arriving : node_topics_.arriving) {
    if (!declared.insert(arriving.topic).second) continue;
    client.read<msg::String>(bus::spec({arriving.topic, arriving.type, false, topics::radio_depth(nodes_)}),
                             Counterpart::router, [&received, topic = arriving.ros_topic](const msg::String& m) {
                               received.push_back({topic, m.data(), std::nullopt});
                             });
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
