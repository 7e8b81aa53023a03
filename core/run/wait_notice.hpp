// Decides when to print a notice about a long wait: after five seconds, then each time the wait has doubled. So the log
// shows every long wait, but does not fill up. Pure: the caller passes the time.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace skein {

class WaitNotice {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kFirst{5};

  explicit WaitNotice(Clock::time_point since, std::chrono::milliseconds first = kFirst)
      : since_(since), next_(first) {}

  /// @returns how long the wait has lasted [s] when a notice is due, once for each notice; else nullopt.
  std::optional<double> due(Clock::time_point now) {
    if (now - since_ < next_) return std::nullopt;
    while (next_ <= now - since_) next_ *= 2;
    return waited_s(now);
  }
  /// Time left until the next notice is due; 0 when it is due now.
  std::chrono::milliseconds left(Clock::time_point now) const {
    return std::max(std::chrono::ceil<std::chrono::milliseconds>(since_ + next_ - now), std::chrono::milliseconds(0));
  }
  double waited_s(Clock::time_point now) const { return std::chrono::duration<double>(now - since_).count(); }

 private:
  Clock::time_point since_;
  std::chrono::milliseconds next_;
};

}  // namespace skein
