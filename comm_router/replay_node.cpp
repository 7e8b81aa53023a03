#include "comm_router/replay_node.hpp"

#include <memory>

#include "comm_router/recording_node.hpp"
#include "idl/cdr.hpp"
#include "recording/choice.hpp"

namespace skein::router {
namespace {

std::map<std::string, std::size_t> numbers_of(const Scenario& scenario, const std::vector<RadioRoute>& routes) {
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    numbers[recording::recorded_topic(scenario.node_name(routes[i].source), routes[i].ros_topic)] = i;
  }
  return numbers;
}

}  // namespace

ReplayNode::ReplayNode(const Scenario& scenario, const std::vector<RadioRoute>& routes,
                       const recording::ReplayOptions& options)
    : scenario_(scenario),
      routes_(routes),
      options_(options),
      by_topic_(numbers_of(scenario, routes)),
      run_(options.file,
           [this](const std::string& topic) { return by_topic_.contains(topic) || topic == kArrivalsTopic; }) {
  run_.each([&](Tick, const recording::Said& said) {
    msg::Arrivals arrivals;
    if (said.topic != kArrivalsTopic || !decode(said.payload, arrivals)) return;
    for (const msg::Arrival& arrival : arrivals.arrivals()) {
      if (by_topic_.contains(recording::recorded_topic(arrival.source(), arrival.topic()))) continue;
      throw InputError(options_.file.string() + ": " + arrival.source() + " registered the radio topic " +
                       arrival.topic() + " while it flew; such a run cannot be flown again");
    }
  });
}

void ReplayNode::replace(StepBatch& batch) {
  const Tick tick = static_cast<Tick>(batch.k) * scenario_.exchange_ticks();
  if (!options_.replays(tick)) return;
  std::map<std::size_t, std::vector<mcap::Bytes>> now, recorded;
  for (const SentMessage& message : batch.messages) now[message.route].push_back(*message.payload);
  batch.messages.clear();
  for (const recording::Said& said : run_.at(tick)) {
    const auto route = by_topic_.find(said.topic);
    if (route == by_topic_.end()) continue;
    recorded[route->second].push_back(said.payload);
    batch.messages.push_back(
        {route->second, said.sequence, std::make_shared<const std::vector<std::uint8_t>>(said.payload)});
  }
  for (const auto& [topic, route] : by_topic_) {
    const std::string node = scenario_.node_name(routes_[route].source);
    if (!options_.compares(node)) continue;
    differences_.compare(node, topic, routes_[route].type, tick, recorded[route], now[route]);
  }
}

}  // namespace skein::router
