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
#include "core/scenario/scenario.hpp"

namespace skein::router {

/// A radio topic in the domain of one node. @param sources  number of nodes that may send on it.
bus::TopicSpec radio_spec(const std::string& topic, const std::string& type, std::size_t sources = 1);

class Arrivals {
 public:
  using Participants = std::vector<std::unique_ptr<bus::Participant>>;  ///< by node

  /// @param scenario, nodes  must outlive this.
  Arrivals(const Scenario& scenario, const Participants& nodes) : scenario_(scenario), nodes_(nodes) {}

  /// Makes `tap` record the messages of all routes, but no replies. Call it before any route is opened. `tap` must
  /// outlive this.
  void record_with(bus::Tap& tap) { tap_ = &tap; }
  /// Opens the topic for replies to a node's radio requests. Call it once for each node, in the order of the nodes.
  void open_replies(Node node);
  /// Opens the arrival topics of a route at those targets that are new since the last call for this route.
  /// @param number  the route's number: either that of a route that was opened before, or the next unused number.
  void open_route(std::size_t number, const RadioRoute& route);
  /// Closes those arrival topics of a route that no other route uses.
  void close_route(std::size_t number);

  /// Whether the target's arrival topic is open, and its writer is matched with a reader of the participant.
  bool reaches(const RadioTarget& target, bus::ParticipantId participant) const;
  /// The first open topic of this node that is in `reads`, and whose writer is not yet matched with a reader of the
  /// participant; empty: there is none.
  std::string unmatched(Node node, const std::vector<std::string>& reads, bus::ParticipantId participant) const;

  /// Writes a message to a target of a route. @param target  index into the route's targets.
  void write(std::size_t route, std::size_t target, std::span<const std::uint8_t> payload);
  /// Writes a reply to a node's radio request.
  void write_reply(Node node, std::span<const std::uint8_t> payload);
  /// Ends a step. @returns by node, for each topic that got a message in this step, the number of its messages so far.
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
  std::vector<std::vector<std::size_t>> of_route_;  ///< by route and target: index into arrivals_
  std::vector<std::size_t> replies_of_;             ///< by node: index into arrivals_
  /// By node and index into arrivals_, for the topics that got a message in this step: number of messages so far.
  std::map<Node, std::map<std::size_t, std::uint64_t>> delivered_;
};

}  // namespace skein::router
