#include "uav_agent/stand_in_node.hpp"

#include <spdlog/spdlog.h>

#include <set>
#include <utility>

#include "bus/lockstep/names.hpp"
#include "bus/lockstep/strangers.hpp"
#include "core/radio/radio_routes.hpp"
#include "idl/cdr.hpp"

namespace skein::agent {
namespace {

std::vector<topics::WireTopic> commands(const std::string& uav, const std::vector<std::string>& debug_names) {
  std::vector<topics::WireTopic> result;
  for (const topics::TopicInfo& topic : topics::uav_topics()) {
    if (topic.direction == topics::Direction::from_agent) result.push_back(topics::wire(topic, uav));
  }
  for (const std::string& name : debug_names) result.push_back(topics::debug(uav, name));
  return result;
}

/// The radio topics on which the scenario lets the UAV send, except the topic of captures: UserNode sends on that one.
std::vector<topics::WireTopic> radio(const Scenario& scenario, Node node) {
  std::vector<topics::WireTopic> result;
  std::set<std::string> known = {topics::captures(scenario.node_name(node)).name};
  for (const RadioRoute& route : radio_routes(scenario)) {
    if (route.source != node || !route.member.empty() || !known.insert(route.topic).second) continue;
    result.push_back({route.topic, route.type, false, topics::kRadioDepth});
  }
  return result;
}

}  // namespace

StandInNode::StandInNode(const Scenario& scenario, UavIndex uav, int base_domain, bus::Bus& bus,
                         const std::vector<std::string>& debug_names)
    : UserNode(scenario, node_of_uav(uav), uav_domain(base_domain, uav), bus,
               {.reads = {topics::command_rejected(scenario.fleet[uav].name)},
                .writes = commands(scenario.fleet[uav].name, debug_names)}),
      uav_(scenario.fleet[uav].name) {
  for (const auto& all : {commands(uav_, debug_names), radio(scenario, node_of_uav(uav))}) {
    for (const topics::WireTopic& topic : all) relays_.emplace_back(topic, scenario.exchange_period_s);
  }
}

// Destroys the readers first: start() of the base class replaces the participant to which they belong.
void StandInNode::start() {
  ears_.clear();
  UserNode::start();
}

// A participant receives nothing from its own writers, so messages that this node relays do not come back to it.
void StandInNode::declare(bus::LockstepClient& client) {
  UserNode::declare(client);
  was_away_ = joins() > 1;
  for (Relay& relay : relays_) {
    ears_.push_back(inbox().subscribe(
        participant(), bus::spec(relay.topic()),
        [&relay](bus::Sample&& sample) { relay.hear(std::move(sample.payload)); }, bus::Bell::silent));
  }
}

bool StandInNode::may_think() {
  UserNode::may_think();
  answer();
  return true;
}

void StandInNode::work(const bus::LockstepClient::Step& step) {
  count_rejections();
  const double now_s = static_cast<double>(step.tick()) / static_cast<double>(kTicksPerSecond);
  for (Relay& relay : relays_) {
    if (was_away_) relay.forget();
    for (Relay::Payload& payload : relay.take(now_s)) say(relay.topic().name, std::move(payload));
  }
  was_away_ = false;
}

void StandInNode::count_rejections() {
  for (const WireMessage& message : take()) {
    msg::CommandRejected rejected;
    if (message.topic != topics::command_rejected(uav_).name || !decode(message.payload, rejected)) continue;
    if (rejected.reason() == bus::kUnheardReason) continue;
    for (Relay& relay : relays_) {
      if (relay.topic().name != rejected.command()) continue;
      if (relay.report().refused == 0U) spdlog::warn("{}: {}", rejected.command().substr(2), rejected.reason());
      relay.reject();
    }
  }
}

std::optional<std::vector<RelayedTopic>> StandInNode::from_nodes() const {
  std::vector<RelayedTopic> heard;
  for (const Relay& relay : relays_) {
    RelayedTopic report = relay.report();
    if (report.received != 0U) heard.push_back(std::move(report));
  }
  return heard;
}

}  // namespace skein::agent
