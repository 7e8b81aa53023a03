#include "comm_router/arrivals_node.hpp"

#include <algorithm>
#include <utility>

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"

namespace skein::router {

bus::TopicSpec radio_spec(const std::string& topic, const std::string& type, std::size_t sources) {
  return {topic, type, bus::Qos{.reliable = true, .latched = false, .depth = topics::radio_depth(sources)}};
}

void Arrivals::open_replies(Node node) {
  const bus::TopicSpec replies = bus::spec(topics::radio_reply());
  replies_of_.push_back(arrivals_.size());
  arrivals_.push_back({node, replies.name, std::make_unique<bus::CountedWriter>(*nodes_[node], replies)});
}

void Arrivals::open_route(std::size_t number, const RadioRoute& route) {
  if (number == of_route_.size()) of_route_.emplace_back();
  for (std::size_t t = of_route_[number].size(); t < route.targets.size(); ++t) {
    of_route_[number].push_back(find_or_open(route.targets[t], route.type));
  }
}

void Arrivals::close_route(std::size_t number) {
  const std::vector<std::size_t> arrivals = std::exchange(of_route_[number], {});
  for (const std::size_t arrival : arrivals) {
    const auto uses = [&](const std::vector<std::size_t>& used) {
      return std::ranges::find(used, arrival) != used.end();
    };
    if (std::ranges::none_of(of_route_, uses)) arrivals_[arrival].writer.reset();
  }
}

std::vector<Arrivals::Arrival>::const_iterator Arrivals::find(const RadioTarget& target) const {
  return std::ranges::find_if(arrivals_,
                              [&](const Arrival& a) { return a.node == target.node && a.topic == target.topic; });
}

std::size_t Arrivals::find_or_open(const RadioTarget& target, const std::string& type) {
  const auto number = static_cast<std::size_t>(find(target) - arrivals_.begin());
  if (number == arrivals_.size()) arrivals_.push_back({target.node, target.topic, nullptr});
  if (!arrivals_[number].writer) {
    const bus::TopicSpec topic = radio_spec(target.topic, type, nodes_.size());
    bus::Ear ear = tap_ ? tap_->ear(scenario_.node_name(target.node), topic) : bus::Ear{};
    arrivals_[number].writer = std::make_unique<bus::CountedWriter>(*nodes_[target.node], topic, std::move(ear));
  }
  return number;
}

bool Arrivals::reaches(const RadioTarget& target, bus::ParticipantId participant) const {
  const auto arrival = find(target);
  return arrival != arrivals_.end() && arrival->writer && arrival->writer->matches(participant);
}

std::string Arrivals::unmatched(Node node, const std::vector<std::string>& reads,
                                bus::ParticipantId participant) const {
  for (const Arrival& arrival : arrivals_) {
    const bool read = arrival.node == node && arrival.writer && std::ranges::find(reads, arrival.topic) != reads.end();
    if (read && !arrival.writer->matches(participant)) return arrival.topic;
  }
  return "";
}

void Arrivals::write(std::size_t route, std::size_t target, std::span<const std::uint8_t> payload) {
  write_to(of_route_[route][target], payload);
}

void Arrivals::write_reply(Node node, std::span<const std::uint8_t> payload) { write_to(replies_of_[node], payload); }

void Arrivals::write_to(std::size_t index, std::span<const std::uint8_t> payload) {
  Arrival& arrival = arrivals_[index];
  const auto [entry, first] = delivered_[arrival.node].try_emplace(index, 0);
  if (first) arrival.writer->begin_step();
  arrival.writer->write(payload);
  entry->second = arrival.writer->count();
}

std::vector<msg::NodeCounts> Arrivals::take_delivered() {
  std::vector<msg::NodeCounts> nodes;
  for (const auto& [node, counts] : std::exchange(delivered_, {})) {
    msg::NodeCounts& entry = nodes.emplace_back();
    entry.node(scenario_.node_name(node));
    for (const auto& [index, total] : counts) {
      entry.delivered().push_back(bus::topic_count(arrivals_[index].topic, nodes_[node]->id(), total));
    }
  }
  return nodes;
}

}  // namespace skein::router
