// Queue for the messages of programs outside the lock-step on one topic, until the next step takes them, with counts of
// what became of them. Pure; times are simulated [s].   Threads: one.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "core/topics.hpp"
#include "process/reports/relayed_topic.hpp"

namespace skein::agent {

class Relay {
 public:
  using Payload = std::vector<std::uint8_t>;  ///< with encapsulation header

  /// @param topic  its depth limits the messages of one step. Messages of types that Skein knows are checked.
  /// @param exchange_s  duration of a step.
  Relay(topics::WireTopic topic, double exchange_s);

  const topics::WireTopic& topic() const { return topic_; }
  /// Queues a sample. If the queue has the topic's depth, the oldest message is lost. A sample that is not a message of
  /// the topic's type is refused.
  void hear(Payload payload);
  /// Discards all queued messages, and counts them as lost: they are from before the UAV's program came back.
  void forget();
  /// Takes all queued messages, oldest first, to hand them on with the step that begins at `now_s`. A message whose
  /// stamp is older than two exchanges counts as late, but is handed on, too; one without a stamp never counts as late.
  std::vector<Payload> take(double now_s);
  /// Call it when sim_server has rejected a message that was handed on: it counts as refused, too.
  void reject() { ++refused_; }
  RelayedTopic report() const;

 private:
  void judge(const Payload& payload, double now_s);

  const topics::WireTopic topic_;
  const double late_after_s_;
  std::deque<Payload> waiting_;
  std::uint64_t received_ = 0, handed_on_ = 0, late_ = 0, lost_ = 0, refused_ = 0, other_clock_ = 0;
};

}  // namespace skein::agent
