// One UAV's share of the strips, flown again and again: a round is all of them once, and each round goes back over the
// tour from where the last one ended.
// Threads: one.
#pragma once

#include <deque>

#include "uav_agent/planning/work_share.hpp"

namespace skein::agent {

class PatrolRounds {
 public:
  /// Once, before the first round.
  void know_share(WorkShare share) { share_ = std::move(share); }
  /// There is not a single strip in the share.
  bool without_work() const { return share_.tour.empty(); }

  /// The next round, where the last one ended.
  void begin();
  /// Rounds begun before this one; -1 before the first.
  int number() const { return number_; }
  /// Nothing is left of this round.
  bool over() const { return to_do_.empty(); }

  /// Takes up what comes next; the round must not be over.
  void take_next();
  const Strip& strip() const { return share_.strips[share_.tour[current_].strip]; }
  bool reversed() const { return share_.tour[current_].reversed; }
  /// The strip taken last comes again: next, or at the end of the round.
  void again_next() { to_do_.push_front(current_); }
  void again_last() { to_do_.push_back(current_); }

 private:
  WorkShare share_;
  std::deque<std::size_t> to_do_;  ///< of this round: indices into share_.tour
  std::size_t current_ = 0;        ///< index into share_.tour
  int number_ = -1;
};

}  // namespace skein::agent
