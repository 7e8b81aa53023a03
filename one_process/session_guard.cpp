#include "one_process/session_guard.hpp"

#include <poll.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <system_error>

#include "one_process/death_notice.hpp"
#include "one_process/stepped_fleet.hpp"
#include "process/program.hpp"

namespace skein::one_process {
namespace {

constexpr std::chrono::milliseconds kLook{250};

// A signal handler can access only globals.
std::atomic<int> guarded_socket = -1;
std::atomic<const SteppedFleet*> guarded_fleet = nullptr;
std::atomic<std::uint64_t> most_looks = 0, looks = 0, turn_seen = 0;

/// Uses only what is allowed in a signal handler: poll(), _exit() and atomics.
void on_timer(int) {
  const int saved = errno;
  pollfd other{guarded_socket.load(), POLLRDHUP, 0};
  if (::poll(&other, 1, 0) > 0 && (other.revents & (POLLRDHUP | POLLHUP | POLLERR | POLLNVAL)) != 0) ::_exit(kExitDone);
  if (const SteppedFleet* fleet = guarded_fleet.load(); fleet != nullptr && most_looks > 0) {
    const std::uint64_t now = fleet->turns();
    const bool in_turn = now % 2 == 1;
    if (now != turn_seen.exchange(now) || !in_turn) {
      looks = 0;
    } else if (++looks >= most_looks) {
      DeathNotice::give_up_at_once();
    }
  }
  errno = saved;
}

}  // namespace

SessionGuard::SessionGuard(double patience_s) {
  const double look_s = std::chrono::duration<double>(kLook).count();
  most_looks = static_cast<std::uint64_t>(patience_s / look_s) + (patience_s > 0.0 ? 1 : 0);
}

void SessionGuard::watch(int socket) {
  guarded_socket = socket;
  struct sigaction action {};
  action.sa_handler = on_timer;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGALRM, &action, nullptr);
  const timeval period{0, std::chrono::microseconds(kLook).count()};
  const itimerval timer{period, period};
  if (::setitimer(ITIMER_REAL, &timer, nullptr) != 0) throw std::system_error(errno, std::generic_category(), "timer");
}

void SessionGuard::look_after(const SteppedFleet* fleet) {
  looks = 0;
  guarded_fleet = fleet;
}

}  // namespace skein::one_process
