#include "one_process/watchdog.hpp"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <vector>

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
  struct Seen {
    std::uint64_t turn = 0;
    Clock::time_point since = Clock::now();
  };
  const auto patience = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_s));
  std::vector<Seen> seen(crew_.seats());
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, patience / 10, [this] { return over_; })) {
    for (std::size_t seat = 0; seat < seen.size(); ++seat) {
      const std::uint64_t now = crew_.turns(seat);
      if (now != seen[seat].turn || now % 2 == 0) {
        seen[seat] = {now, Clock::now()};
      } else if (Clock::now() - seen[seat].since >= patience) {
        if (const DeathNotice* holder = crew_.holder(seat); holder != nullptr && crew_.turns(seat) == now) {
          holder->give_up(
              fmt::format("this program did not end its turn for {} s, and the whole fleet waits for it", patience_s));
        }
      }
    }
  }
}

}  // namespace skein::one_process
