// What programs outside of the lock-step say on one topic, until a step takes it along; and the count of what became of
// it. Pure; times are simulated [s].   Threads: none of this is shared.
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

  /// @param topic  its depth is what a step may hold; its type decides what is checked: of types that Skein does not
  ///   know, nothing. @param exchange_s  the duration of a step.
  Relay(topics::WireTopic topic, double exchange_s);

  const topics::WireTopic& topic() const { return topic_; }
  /// A sample has arrived. Where a step can hold no more, the oldest that waits is lost. Refuses what is no message.
  void hear(Payload payload);
  /// All that waits is lost: its time is over.
  void forget();
  /// All that waits, oldest first: it is handed on with the step that begins at `now_s`. A message is late if its stamp
  /// is older than two exchanges; without a stamp it never is.
  std::vector<Payload> take(double now_s);
  /// sim_server has rejected a message that was handed on.
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
