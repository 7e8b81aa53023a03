#include "comm_router/link_gate.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <string>
#include <tuple>

#include "core/text/sha256.hpp"

namespace skein::router {

LinkGate::LinkGate(const std::vector<RadioRoute>& routes, std::size_t nodes, std::unique_ptr<LinkModel> links)
    : routes_(routes), model_(std::move(links)), counts_(nodes) {}

GatedStep LinkGate::gate(std::uint64_t k, const Links& links, const std::vector<SentMessage>& messages) {
  if (links.nodes() != counts_.nodes()) {
    throw std::invalid_argument("links between " + std::to_string(links.nodes()) + " radio nodes where there are " +
                                std::to_string(counts_.nodes()));
  }
  model_->begin_step(links);
  for (const SentMessage& message : messages) send(k, links, message);

  GatedStep step;
  const auto due = in_flight_.upper_bound(k + 1);
  for (auto arrival = in_flight_.begin(); arrival != due; ++arrival) {
    std::ranges::move(arrival->second, std::back_inserter(step.deliveries));
  }
  in_flight_.erase(in_flight_.begin(), due);
  // Stable: two programs of one node may use the same topic and sequence number; for each target, their messages stay
  // in the order of sending. Targets are ordered by node, not by index, which depends on when a route got them.
  std::ranges::stable_sort(step.deliveries, {}, [&](const Delivery& delivery) {
    const RadioRoute& route = routes_[delivery.route];
    return std::tuple<Node, const std::string&, std::uint64_t, Node>(route.source, route.ros_topic, delivery.sequence,
                                                                     route.targets[delivery.target].node);
  });
  for (const Delivery& delivery : step.deliveries) {
    const RadioRoute& route = routes_[delivery.route];
    LinkCounts& link = counts_.at(route.source, route.targets[delivery.target].node);
    ++link.delivered;
    link.delivered_bytes += delivery.payload->size();
  }
  step.digest = digest(step.deliveries);
  return step;
}

void LinkGate::send(std::uint64_t k, const Links& links, const SentMessage& message) {
  if (message.route >= routes_.size()) throw std::invalid_argument("a radio message of no route");
  const RadioRoute& route = routes_[message.route];
  for (std::size_t target = 0; target < route.targets.size(); ++target) {
    const Node to = route.targets[target].node;
    LinkCounts& link = counts_.at(route.source, to);
    ++link.sent;
    link.sent_bytes += message.payload->size();
    if (links.at(route.source, to) == 0) {
      ++link.dropped_no_los;
      continue;
    }
    const LinkFate fate = model_->fate(k, route, to, message);
    link.dropped_fault += fate.loss == LinkLoss::fault;
    link.dropped_overflow += fate.loss == LinkLoss::overflow;
    if (fate.loss != LinkLoss::none) continue;
    link.duplicated += static_cast<std::uint64_t>(fate.copies - 1);
    link.corrupted += fate.payload != nullptr;
    const Payload& payload = fate.payload ? fate.payload : message.payload;
    for (int copy = 0; copy < fate.copies; ++copy) {
      in_flight_[k + 1 + fate.delay_steps].push_back({message.route, target, message.sequence, payload});
    }
  }
}

std::vector<std::uint8_t> LinkGate::digest(const std::vector<Delivery>& deliveries) const {
  if (deliveries.empty()) return {};
  Sha256 sha;
  const std::vector<std::uint8_t>* hashed = nullptr;
  std::array<std::uint8_t, 32> payload_hash{};
  for (const Delivery& delivery : deliveries) {
    if (delivery.payload.get() != hashed) {  // copies of a message for several targets follow each other
      hashed = delivery.payload.get();
      payload_hash = Sha256().add(std::span(*hashed)).digest();
    }
    const RadioRoute& route = routes_[delivery.route];
    sha.add(route.source).add(route.targets[delivery.target].node).add(route.ros_topic).add(delivery.sequence);
    sha.add(std::span<const std::uint8_t>(payload_hash));
  }
  const auto bytes = sha.digest();
  return {bytes.begin(), bytes.end()};
}

LinkCounts LinkGate::total() const {
  LinkCounts sum;
  for (const LinkCounts& link : counts_.row_major()) {
    sum.sent += link.sent;
    sum.delivered += link.delivered;
    sum.dropped_no_los += link.dropped_no_los;
    sum.dropped_fault += link.dropped_fault;
    sum.dropped_overflow += link.dropped_overflow;
    sum.duplicated += link.duplicated;
    sum.corrupted += link.corrupted;
    sum.sent_bytes += link.sent_bytes;
    sum.delivered_bytes += link.delivered_bytes;
  }
  return sum;
}

}  // namespace skein::router
