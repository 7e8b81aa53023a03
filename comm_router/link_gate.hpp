// The radio: which of a step's messages reach whom, and when. A message sent in step k is judged with the links of
// step k and arrives in step k + 1, or later where a link delays it. Order, counts and digest depend on nothing but
// the messages and the links. Not thread-safe; no bus.
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

/// Shared, because one message goes to several targets and may wait in a delay queue: no copy for each.
using Payload = std::shared_ptr<const std::vector<std::uint8_t>>;

/// One message as its sender put it on the air.
struct SentMessage {
  std::size_t route = 0;       ///< number in the RadioTable; names source and topic
  std::uint64_t sequence = 0;  ///< 0, 1, ... on this route since the sender joined
  Payload payload;             ///< serialised, with encapsulation header
};

/// Why a link drops a message that has line of sight.
enum class LinkLoss {
  none,
  fault,    ///< loss, or a cut
  overflow  ///< no room in the queue for its bandwidth
};

/// What a link does to one message that has line of sight.
struct LinkFate {
  LinkLoss loss = LinkLoss::none;
  std::uint64_t delay_steps = 0;  ///< on top of the one step that every message takes
  int copies = 1;                 ///< that arrive, side by side
  Payload payload = {};           ///< that arrives in place of the one that was sent; null: that one
};

/// How links treat messages beyond line of sight. Called once a message and target, in a fixed order; random models
/// must key their draws by (link, topic, sequence), so that a restarted router draws the same.
class LinkModel {
 public:
  virtual ~LinkModel() = default;
  /// The links of the step whose messages come next.
  virtual void begin_step(const Links& /*links*/) {}
  virtual LinkFate fate(std::uint64_t k, const RadioRoute& route, Node target, const SentMessage& message) = 0;
  /// A fault of the fault file that waited for a condition begins with the exchange at this tick. Told before that, and
  /// as often as anybody likes.
  virtual void set_off(std::size_t /*fault*/, Tick /*tick*/) {}
  /// Faults that somebody who watches has added, behind those of the fault file, all of them in their order: others may
  /// follow, and each may get an end. Told before they begin or end, and as often as anybody likes.
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

/// Messages on one directed link, since the router started.
/// sent + duplicated = delivered + dropped_no_los + dropped_fault + dropped_overflow + those still delayed.
/// Bytes are those of the serialised messages, with the four of their encapsulation, without what DDS adds.
struct LinkCounts {
  std::uint64_t sent = 0, delivered = 0, dropped_no_los = 0, dropped_fault = 0;
  std::uint64_t dropped_overflow = 0, duplicated = 0;
  std::uint64_t corrupted = 0;  ///< of those that were not dropped
  std::uint64_t sent_bytes = 0, delivered_bytes = 0;
  bool operator==(const LinkCounts&) const = default;
};

/// What leaves the router after step k.
struct GatedStep {
  std::vector<Delivery> deliveries;  ///< by source, topic, sequence, target; equals: in the order of sending
  /// SHA-256 over the deliveries in this order, empty when there are none: of each source node, target node, ROS topic
  /// (length, bytes), sequence, SHA-256 of the payload; numbers as 8 bytes, little-endian (core/sha256.hpp).
  std::vector<std::uint8_t> digest;
};

class LinkGate {
 public:
  /// @param routes  of the run, a RadioTable's: others may be added, and targets to each. They must outlive this.
  /// @param nodes  number of radio nodes: the fleet and the ground station.
  /// @param links  the model of the links; IdealLinks unless a fault file says otherwise.
  LinkGate(const std::vector<RadioRoute>& routes, std::size_t nodes,
           std::unique_ptr<LinkModel> links = std::make_unique<IdealLinks>());
  LinkGate(std::vector<RadioRoute>&&, std::size_t, std::unique_ptr<LinkModel> = nullptr) = delete;

  /// Judges all messages of step k, and hands out what arrives in step k + 1. Steps come in order.
  /// @param messages  of all members, in an order that is the same in every run (RouterSync's).
  /// @throws std::invalid_argument when the links are those of another fleet or a message names no route.
  GatedStep gate(std::uint64_t k, const Links& links, const std::vector<SentMessage>& messages);

  void set_off(std::size_t fault, Tick tick) { model_->set_off(fault, tick); }
  void set_by_hand(const std::vector<Fault>& faults) { model_->set_by_hand(faults); }
  /// Counts of an earlier life: counting goes on from there.
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
