// The topics on which messages arrive at the nodes, with the router's writers and their counts. All sources of a topic
// share its writer, so their order is one order.
// Threads: one.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/lockstep/counted.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/scenario.hpp"

namespace skein::router {

/// A radio topic in the domain of one node. @param sources  that share it.
bus::TopicSpec radio_spec(const std::string& topic, const std::string& type, std::size_t sources = 1);

class Arrivals {
 public:
  using Participants = std::vector<std::unique_ptr<bus::Participant>>;  ///< by node

  /// Both must outlive this.
  Arrivals(const Scenario& scenario, const Participants& nodes) : scenario_(scenario), nodes_(nodes) {}

  /// Before anything is opened. `tap` must outlive this.
  void record_with(bus::Tap& tap) { tap_ = &tap; }
  /// Where a node gets what its requests came to; in the order of the nodes.
  void open_replies(Node node);
  /// Where the messages of a route arrive: at those of its targets that it has not opened yet.
  void open_route(std::size_t number, const RadioRoute& route);
  /// Topics that no other route needs are closed with it.
  void close_route(std::size_t number);

  bool reaches(const RadioTarget& target, bus::ParticipantId source) const;
  /// The first of the topics that a member reads at its node which is not matched with it yet; empty when all are.
  std::string unmatched(Node node, const std::vector<std::string>& reads, bus::ParticipantId source) const;

  void write(std::size_t route, std::size_t target, std::span<const std::uint8_t> payload);
  void write_reply(Node node, std::span<const std::uint8_t> payload);
  /// Ends a step: the counts so far of the topics that got something in it, by node.
  std::vector<msg::NodeCounts> take_delivered();

 private:
  struct Arrival {
    Node node = kStationNode;
    std::string topic;
    std::unique_ptr<bus::CountedWriter> writer;  ///< null: closed again
  };

  std::vector<Arrival>::const_iterator find(const RadioTarget& target) const;
  std::size_t find_or_open(const RadioTarget& target, const std::string& type);
  void write_to(std::size_t index, std::span<const std::uint8_t> payload);

  const Scenario& scenario_;
  const Participants& nodes_;
  bus::Tap* tap_ = nullptr;
  std::vector<Arrival> arrivals_;
  std::vector<std::vector<std::size_t>> of_route_;                  ///< by route, target: index into arrivals_
  std::vector<std::size_t> replies_of_;                             ///< by node: likewise
  std::map<Node, std::map<std::size_t, std::uint64_t>> delivered_;  ///< in this step: counts so far, likewise
};

}  // namespace skein::router
