#include "uav_agent/client/user_node.hpp"

#include "bus/lockstep/names.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/topics.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "uav_agent/neighbours.hpp"

namespace skein::agent {

using bus::LockstepClient;
using Counterpart = LockstepClient::Counterpart;

UserNode::UserNode(const Scenario& scenario, Node node, int domain, bus::Bus& bus, UserTopics topics)
    : MemberNode(bus, domain, scenario.node_name(node)), scenario_(scenario), node_(node), topics_(std::move(topics)) {
  std::set<std::string> debug;
  for (const topics::WireTopic& topic : topics_.writes) {
    if (!topics::debug_name(topic.name, member()).empty()) debug.insert(topic.name);
  }
  if (debug.size() <= topics::kMostDebugNames) return;
  throw InputError(member() + ": " + std::to_string(debug.size()) + " debug names; at most " +
                   std::to_string(topics::kMostDebugNames) + " are read");
}

/// Called each time the node joins. Messages from before a fault stopped the node are discarded.
void UserNode::declare(LockstepClient& client) {
  ++joins_;
  read_.clear();
  share_.clear();
  arrived_.clear();
  to_send_.clear();
  said_.clear();
  waits_ = answered_ = false;
  fresh_ = true;
  if (is_uav()) declare_custody(client);
  for (const topics::WireTopic& topic : topics_.reads) read(client, topic, Counterpart::server);
  for (const topics::WireTopic& topic : topics_.writes) write(client, topic, Counterpart::server);
  declare_radio(client);
}

void UserNode::read(LockstepClient& client, const topics::WireTopic& topic, Counterpart counterpart) {
  if (!read_.insert(topic.name).second) return;
  client.read(bus::spec(topic), counterpart, [this, name = topic.name](bus::Sample&& sample) {
    arrived_.push_back({name, std::move(sample.payload)});
  });
}

void UserNode::write(LockstepClient& client, const topics::WireTopic& topic, Counterpart counterpart) {
  if (!share_.emplace(topic.name, static_cast<std::size_t>(topic.depth)).second) return;
  client.declare_writer(bus::spec(topic), counterpart);
}

/// Declares the radio topics of the scenario, of any type.
void UserNode::declare_radio(LockstepClient& client) {
  const std::set<std::string> custody = {topics::captures(member()).name, topics::captures_ack_at_uav(member()).name};
  const std::size_t nodes = scenario_.fleet.size() + 1;
  for (const RadioRoute& route : radio_routes(scenario_)) {
    if (!route.member.empty()) continue;  // only the station's own program may send on it
    if (route.source == node_ && !custody.contains(route.topic)) {
      write(client, {route.topic, route.type, false, topics::kRadioDepth}, Counterpart::router);
    }
    for (const RadioTarget& target : route.targets) {
      if (target.node != node_ || custody.contains(target.topic)) continue;
      if (!is_uav() && route.ros_type == kCapturesType) continue;  // the station's own program stores the captures
      read(client, {target.topic, route.type, false, topics::radio_depth(nodes)}, Counterpart::router);
    }
  }
  radio_ = std::make_unique<bus::RadioTopics>(client, member());
}

void UserNode::declare_custody(LockstepClient& client) {
  client.read<msg::CaptureReports>(bus::spec(topics::capture()), Counterpart::server, [this](const auto& m) {
    std::vector<HandedOut> handed_out;
    for (const auto& report : m.reports()) {
      handed_out.push_back({report.capture(), encoded_size(report)});
      reports_.insert_or_assign(report.capture(), report);
    }
    uplink_.take(handed_out);
  });
  client.read<msg::CaptureAck>(bus::spec(topics::captures_ack_at_uav(member())), Counterpart::router,
                               [this](const auto& m) {
                                 const std::vector<std::uint64_t> captures = from_capture_ack(m, member());
                                 uplink_.acknowledge(captures);
                                 released_.insert(released_.end(), captures.begin(), captures.end());
                               });
  const topics::WireTopic neighbours = topics::neighbour_odometry(member());
  read_.insert(neighbours.name);
  client.read(bus::spec(neighbours), Counterpart::server, [this, name = neighbours.name](bus::Sample&& sample) {
    see_neighbours(sample.payload);
    arrived_.push_back({name, std::move(sample.payload)});
  });
  client.declare_writer(bus::spec(topics::captures(member())), Counterpart::router);
  client.declare_writer(bus::spec(topics::capture_stored()), Counterpart::server);
}

void UserNode::see_neighbours(std::span<const std::uint8_t> payload) {
  msg::PointCloud2 cloud;
  if (!decode(payload, cloud)) return;
  const std::vector<Neighbour> neighbours = neighbours_of(cloud);
  station_linked_ = std::ranges::any_of(neighbours, [](const Neighbour& one) { return one.node == kStationNode; });
}

bool UserNode::may_think() {
  if (!waits_) {
    waits_ = true;
    radio_->begin_step();
    if (std::exchange(fresh_, false)) request_again();
  }
  return answered_;
}

/// Repeats all registrations, because a new participant has none.
void UserNode::request_again() {
  for (const auto& [topic, opened] : std::map(opened_)) open(topic, opened.type, opened.targets);
  for (const auto& [topic, type] : std::map(listened_)) listen(topic, type);
}

void UserNode::open(const std::string& topic, const std::string& type, const std::vector<std::string>& targets) {
  radio_->send(topic, type, targets);
  opened_.insert_or_assign(topic, Opened{type, targets});
  share_.emplace(wire_topic(topic), static_cast<std::size_t>(topics::kRadioDepth));
}

void UserNode::listen(const std::string& topic, const std::string& type) {
  const std::string name = wire_topic(arrival_topic(topic, member()));
  radio_->listen(topic, type, [this, name](bus::Sample&& sample) {
    arrived_.push_back({name, std::move(sample.payload)});
  });
  listened_.insert_or_assign(topic, type);
  read_.insert(name);
}

UserNode::Said UserNode::say(const std::string& topic, std::vector<std::uint8_t> payload) {
  const auto share = share_.find(topic);
  if (share == share_.end()) return Said::undeclared;
  const std::string ros_topic = topic.substr(2);
  if (opened_.contains(ros_topic) && !radio_->sending(ros_topic).open) return Said::closed;
  std::size_t& said = said_[topic];
  if (said == share->second) return Said::full;
  ++said;
  to_send_.push_back({topic, std::move(payload)});
  return Said::sent;
}

void UserNode::send(LockstepClient& client) {
  for (const WireMessage& message : to_send_) {
    if (opened_.contains(message.topic.substr(2))) {
      radio_->write(message.topic.substr(2), message.payload);
    } else {
      client.write(message.topic, message.payload);
    }
  }
  if (is_uav()) send_custody(client);
  to_send_.clear();
  said_.clear();
  arrived_.clear();
  waits_ = answered_ = false;
}

void UserNode::send_custody(LockstepClient& client) {
  if (!released_.empty()) client.write(topics::capture_stored().name, to_capture_ack(member(), released_));
  msg::CaptureReports reports;
  for (const std::uint64_t capture : uplink_.send(client.step().k(), station_linked_)) {
    reports.reports().push_back(reports_.at(capture));
  }
  if (!reports.reports().empty()) client.write(topics::captures(member()).name, reports);
  std::erase_if(reports_, [this](const auto& entry) { return !uplink_.holds(entry.first); });
  released_.clear();
}

}  // namespace skein::agent
