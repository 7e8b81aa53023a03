// The topics on which radio messages arrive at the nodes, with the router's writers and their counts. All sources of an
// arrival topic share one writer, so that every reader gets their messages in the same order.
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

/// A radio topic in the domain of one node. @param sources  how many nodes may send on it.
bus::TopicSpec radio_spec(const std::string& topic, const std::string& type, std::size_t sources = 1);

class Arrivals {
 public:
  using Participants = std::vector<std::unique_ptr<bus::Participant>>;  ///< by node

  /// Both must outlive this.
  Arrivals(const Scenario& scenario, const Participants& nodes) : scenario_(scenario), nodes_(nodes) {}

  /// Has `tap` record what arrives. Call it before any route is opened. `tap` must outlive this.
  void record_with(bus::Tap& tap) { tap_ = &tap; }
  /// Opens the topic with the replies to a node's radio requests. Call it once for each node, in their order.
  void open_replies(Node node);
  /// Opens the arrival topics of a route, at those of its targets where it has not done so yet.
  void open_route(std::size_t number, const RadioRoute& route);
  /// Closes the arrival topics of a route that no other route needs.
  void close_route(std::size_t number);

  /// Whether the writer of this arrival topic is matched with a reader of the participant `source`.
  bool reaches(const RadioTarget& target, bus::ParticipantId source) const;
  /// The first topic of `reads` at this node that is not matched with the participant `source` yet; empty: all are.
  std::string unmatched(Node node, const std::vector<std::string>& reads, bus::ParticipantId source) const;

  void write(std::size_t route, std::size_t target, std::span<const std::uint8_t> payload);
  void write_reply(Node node, std::span<const std::uint8_t> payload);
  /// Ends a step. @returns the total counts of the topics on which something arrived in this step, by node.
  std::vector<msg::NodeCounts> take_delivered();

 private:
  struct Arrival {
    Node node = kStationNode;
    std::string topic;
    std::unique_ptr<bus::CountedWriter> writer;  ///< null: the topic is closed
  };

  std::vector<Arrival>::const_iterator find(const RadioTarget& target) const;
  std::size_t find_or_open(const RadioTarget& target, const std::string& type);
  void write_to(std::size_t index, std::span<const std::uint8_t> payload);

  const Scenario& scenario_;
  const Participants& nodes_;
  bus::Tap* tap_ = nullptr;
  std::vector<Arrival> arrivals_;
  std::vector<std::vector<std::size_t>> of_route_;                  ///< by route, target: index into arrivals_
  std::vector<std::size_t> replies_of_;                             ///< by node: index into arrivals_
  std::map<Node, std::map<std::size_t, std::uint64_t>> delivered_;  ///< in this step, by index into arrivals_: total
};

}  // namespace skein::router
