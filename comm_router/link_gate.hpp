// The radio: decides which messages of a step reach which nodes, and when. The links of step k decide about a message
// that is sent in step k; it arrives in step k + 1, or later if a link delays it. Order, counts and digest depend on
// nothing but the messages and the links. Not thread-safe; no bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/radio/link_matrix.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/types.hpp"

namespace skein::router {

/// Shared, so that a message to several targets, which may wait in delay queues, needs no copies.
using Payload = std::shared_ptr<const std::vector<std::uint8_t>>;

/// One message as its sender put it on the air.
struct SentMessage {
  std::size_t route = 0;       ///< number in the RadioTable; names source and topic
  std::uint64_t sequence = 0;  ///< 0, 1, ... on this route since the sender joined
  Payload payload;             ///< serialised, with encapsulation header
};

/// Why a message is lost although its source and target are linked (Links: line of sight and range).
enum class LinkLoss {
  none,
  fault,    ///< random loss, or the link is cut
  overflow  ///< no room in the queue for its bandwidth
};

/// The effect of a link on one message whose source and target are linked.
struct LinkFate {
  LinkLoss loss = LinkLoss::none;
  std::uint64_t delay_steps = 0;  ///< on top of the one step that every message takes
  int copies = 1;                 ///< how many arrive, all in the same step
  Payload payload = {};           ///< arrives instead of the payload that was sent; null: unchanged
};

/// Decides the effects of links on messages between linked nodes (Links tells which nodes are linked). The gate calls
/// fate() once for each message and target, in a fixed order. Random models must key their draws by (link, topic,
/// sequence), so that a restarted router draws the same.
class LinkModel {
 public:
  virtual ~LinkModel() = default;
  /// The links of the step whose messages come next.
  virtual void begin_step(const Links& /*links*/) {}
  virtual LinkFate fate(std::uint64_t k, const RadioRoute& route, Node target, const SentMessage& message) = 0;
  /// A fault of the fault file that waited for a condition begins with the exchange at this tick. The router calls it
  /// before that exchange, and may repeat the call.
  virtual void set_off(std::size_t /*fault*/, Tick /*tick*/) {}
  /// Sets the faults that a viewer has added by hand; they follow those of the fault file. @param faults  all of them
  /// so far, in their order: later calls may append faults, and give a fault an end. The router calls it before a fault
  /// begins or ends, and may repeat the call.
  virtual void set_by_hand(const std::vector<Fault>& /*faults*/) {}
};

/// Nothing is lost, nothing is late.
class IdealLinks final : public LinkModel {
 public:
  LinkFate fate(std::uint64_t, const RadioRoute&, Node, const SentMessage&) override { return {}; }
};

/// One message for one target.
struct Delivery {
  std::size_t route = 0;   ///< number in the RadioTable
  std::size_t target = 0;  ///< index into that route's targets
  std::uint64_t sequence = 0;
  Payload payload;
};

/// Messages on one directed link, since the run began if CountStore keeps the counts (else since the router started).
/// sent + duplicated = delivered + dropped_no_los + dropped_fault + dropped_overflow + those still delayed.
/// dropped_no_los counts messages between nodes that were not linked: no line of sight, out of range, or dead. Bytes
/// are those of the serialised messages, with the four bytes of their encapsulation header, without DDS overhead.
struct LinkCounts {
  std::uint64_t sent = 0, delivered = 0, dropped_no_los = 0, dropped_fault = 0;
  std::uint64_t dropped_overflow = 0, duplicated = 0;
  std::uint64_t corrupted = 0;  ///< of those that were not dropped, with flipped bits
  std::uint64_t sent_bytes = 0, delivered_bytes = 0;
  bool operator==(const LinkCounts&) const = default;
};

/// The messages that leave the router after step k.
struct GatedStep {
  std::vector<Delivery> deliveries;  ///< by source, topic, sequence, target; ties: in the order of sending
  /// SHA-256 over the deliveries in this order, empty when there are none: of each source node, target node, ROS topic
  /// (length, bytes), sequence, SHA-256 of the payload; numbers as 8 bytes, little-endian (core/text/sha256.hpp).
  std::vector<std::uint8_t> digest;
};

class LinkGate {
 public:
  /// @param routes  those of the run's RadioTable, which may add routes, and targets to routes. They must outlive this.
  /// @param nodes  number of radio nodes: the fleet and the ground station.
  /// @param links  the model of the links.
  LinkGate(const std::vector<RadioRoute>& routes, std::size_t nodes,
           std::unique_ptr<LinkModel> links = std::make_unique<IdealLinks>());
  LinkGate(std::vector<RadioRoute>&&, std::size_t, std::unique_ptr<LinkModel> = nullptr) = delete;

  /// Judges all messages of step k. Call it in the order of steps. @returns what arrives in step k + 1.
  /// @param messages  of all members, in an order that is the same in every run (RouterSync's).
  /// @throws std::invalid_argument when `links` has another number of nodes, or a message names no route.
  GatedStep gate(std::uint64_t k, const Links& links, const std::vector<SentMessage>& messages);

  void set_off(std::size_t fault, Tick tick) { model_->set_off(fault, tick); }
  void set_by_hand(const std::vector<Fault>& faults) { model_->set_by_hand(faults); }
  /// Takes the counts from before a restart; counting continues from there.
  void restore(LinkMatrix<LinkCounts> counts) { counts_ = std::move(counts); }

  const std::vector<RadioRoute>& routes() const { return routes_; }
  const LinkMatrix<LinkCounts>& counts() const { return counts_; }
  LinkCounts total() const;
  FirstNodes nodes() const { return FirstNodes(counts_.nodes()); }

 private:
  void send(std::uint64_t k, const Links& links, const SentMessage& message);
  std::vector<std::uint8_t> digest(const std::vector<Delivery>& deliveries) const;

  const std::vector<RadioRoute>& routes_;
  std::unique_ptr<LinkModel> model_;
  LinkMatrix<LinkCounts> counts_;
  std::map<std::uint64_t, std::vector<Delivery>> in_flight_;  ///< by the step in which they arrive
};

}  // namespace skein::router
