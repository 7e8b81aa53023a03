#include "one_process/watchdog.hpp"

#include <spdlog/fmt/fmt.h>

#include <chrono>

#include "one_process/death_notice.hpp"

namespace skein::one_process {

Watchdog::Watchdog(const Crew& crew, double patience_s) : crew_(crew) {
  if (patience_s > 0.0) thread_ = std::thread([this, patience_s] { watch(patience_s); });
}

Watchdog::~Watchdog() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Watchdog::watch(double patience_s) {
  using Clock = std::chrono::steady_clock;
  const auto patience = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_s));
  std::uint64_t turn = 0;
  Clock::time_point since = Clock::now();
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, patience / 10, [this] { return over_; })) {
    const std::uint64_t now = crew_.turns();
    const bool in_turn = now % 2 == 1;
    if (now != turn || !in_turn) {
      turn = now;
      since = Clock::now();
    } else if (Clock::now() - since >= patience) {
      DeathNotice::give_up(
          fmt::format("this program did not end its turn for {} s, and with it stands the fleet", patience_s));
    }
  }
}

}  // namespace skein::one_process
