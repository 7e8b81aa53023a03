// Until when the programs of a run may leave. Wall time, but for what the launcher itself stood still (Ctrl-Z,
// SIGSTOP): its programs may have stood still with it, and what they did meanwhile it has not looked at yet.
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
  /// 0: it is over. Only if it is set.
  milliseconds left(Clock::time_point now = Clock::now()) const {
    return std::max(std::chrono::ceil<milliseconds>(*by_ - now), milliseconds(0));
  }
  /// What should have taken `asked` at most took this long: the launcher stood still meanwhile.
  void excuse(Clock::duration took, milliseconds asked) {
    if (by_ && took > asked + kStandstill) *by_ += took - asked;
  }

 private:
  static constexpr milliseconds kStandstill{2000};  ///< a busy machine does not take longer for a look

  std::optional<Clock::time_point> by_;
};

}  // namespace skein::cli
