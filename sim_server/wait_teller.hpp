// Tells the launcher and the log whom the fleet waits for, as long as it does.   Threads: one.
#pragma once

#include <string>
#include <vector>

#include "core/run/wait_notice.hpp"
#include "process/status/status_pipe.hpp"

namespace skein::sim {

struct AwaitedMember {
  std::string name;
  std::string missing;  ///< what of it: "rt/plan 3 of 4"
};

class WaitTeller {
 public:
  /// The wait begins now. @param what  is awaited of somebody: "to join". @param status  must outlive this.
  WaitTeller(StatusPipe& status, const char* what) : status_(status), what_(what), notice_(told_) {}

  /// To be called again and again while the wait lasts. The launcher hears of it twice a second once it is no trifle,
  /// the log when a line is due (core/run/wait_notice.hpp); "due" marks that for the launcher, too.
  /// @param awaited  gives whom; only asked when there is something to tell.
  /// @returns false while it is a trifle.
  template <class Awaited>
  bool tell(const Awaited& awaited) {
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
