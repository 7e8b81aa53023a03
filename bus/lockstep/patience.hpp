// A time-out that counts only the time in which the waiting process was running. While a process stands still (stopped,
// swapped out, its machine asleep), a wall clock advances and answers stay unread, which is not the fault of the
// program that is waited for. Not thread-safe.
#pragma once

#include <algorithm>
#include <chrono>

namespace skein::bus {

class Patience {
 public:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  /// Of the time between two calls of over(), at most this counts: in the rest, the process was not running.
  static constexpr Seconds kLongestLook{1.0};

  /// @param limit_s  0: no limit
  explicit Patience(double limit_s, Clock::time_point now = Clock::now()) : limit_s_(limit_s), last_look_(now) {}

  /// Call it at least once every kLongestLook. @returns true when the wait has reached the limit.
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
