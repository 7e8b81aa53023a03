// The deadline by which the programs of a run must have left, in wall time. Time in which the launcher was stopped
// (Ctrl-Z, SIGSTOP) does not count: its programs may have been stopped too, and it has not read their output yet.
// Threads: one.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace skein::cli {

class LeaveDeadline {
 public:
  using Clock = std::chrono::steady_clock;
  using milliseconds = std::chrono::milliseconds;

  bool is_set() const { return by_.has_value(); }
  void set(milliseconds from_now, Clock::time_point now = Clock::now()) { by_ = now + from_now; }
  void bring_forward(milliseconds from_now, Clock::time_point now = Clock::now()) {
    by_ = by_ ? std::min(*by_, now + from_now) : now + from_now;
  }
  /// Time left; 0: the deadline has passed. Call it only if is_set().
  milliseconds left(Clock::time_point now = Clock::now()) const {
    return std::max(std::chrono::ceil<milliseconds>(*by_ - now), milliseconds(0));
  }
  /// Postpones the deadline if a wait of at most `asked` took so much longer that the launcher must have been stopped.
  void excuse(Clock::duration took, milliseconds asked) {
    if (by_ && took > asked + kStandstill) *by_ += took - asked;
  }

 private:
  static constexpr milliseconds kStandstill{2000};  ///< a busy machine does not delay a wait longer

  std::optional<Clock::time_point> by_;
};

}  // namespace skein::cli
