// Tells the launcher and the log which members the fleet waits for, while it waits.   Threads: one.
#pragma once

#include <string>
#include <vector>

#include "core/run/wait_notice.hpp"
#include "process/status/status_pipe.hpp"

namespace skein::sim {

struct AwaitedMember {
  std::string name;
  std::string missing;  ///< what it still has to send: "rt/plan 3 of 4"
};

class WaitTeller {
 public:
  /// The wait begins now. @param what  the members are to do: "to join". @param status  must outlive this.
  WaitTeller(StatusPipe& status, const char* what) : status_(status), what_(what), notice_(told_) {}

  /// Call it often while the wait lasts. After kTrifle_s it tells the launcher twice a second, and the log when a line
  /// is due (core/run/wait_notice.hpp). The message for the launcher says whether a line is due.
  /// @param awaited  returns the awaited members; called only when there is something to tell.
  /// @returns false until the wait has lasted kTrifle_s.
  bool tell(const auto& awaited) {
    const auto now = WaitNotice::Clock::now();
    if (notice_.waited_s(now) < kTrifle_s) return false;
    if (now - told_ >= kPeriod) send(awaited(), now);
    return true;
  }

  const char* what() const { return what_; }

 private:
  static constexpr double kTrifle_s = 1.0;
  static constexpr std::chrono::milliseconds kPeriod{500};

  void send(const std::vector<AwaitedMember>& awaited, WaitNotice::Clock::time_point now);

  StatusPipe& status_;
  const char* what_;
  WaitNotice::Clock::time_point told_ = WaitNotice::Clock::now();
  WaitNotice notice_;
};

}  // namespace skein::sim
