// How long somebody is waited for. A wall clock goes on while a process stands still (stopped, swapped out, its machine
// asleep) and what arrived meanwhile lies unread: that is nobody else's fault. So only the time counts in which the one
// who waits was awake to see an answer. Not thread-safe.
#pragma once

#include <algorithm>
#include <chrono>

namespace skein::bus {

class Patience {
 public:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  /// More than this between two looks was not spent awake.
  static constexpr Seconds kLongestLook{1.0};

  /// @param limit_s  0: for ever
  explicit Patience(double limit_s, Clock::time_point now = Clock::now()) : limit_s_(limit_s), last_look_(now) {}

  /// Look at least as often as kLongestLook. @returns true when it has been waited for long enough.
  bool over(Clock::time_point now = Clock::now()) {
    waited_ += std::min<Seconds>(now - last_look_, kLongestLook);
    last_look_ = now;
    return limit_s_ > 0.0 && waited_.count() >= limit_s_;
  }

 private:
  double limit_s_;
  Clock::time_point last_look_;
  Seconds waited_{0.0};
};

}  // namespace skein::bus
