#include "process/debugger_wait.hpp"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <string>

namespace skein {
namespace {

/// By which the signal's handler wakes the wait.
std::atomic<int> continued_fd = -1;

extern "C" void on_continue(int) { ::eventfd_write(continued_fd, 1); }

}  // namespace

bool is_debugged() {
  std::ifstream in("/proc/self/status");
  const std::string key = "TracerPid:\t";
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(key)) return line != key + "0";
  }
  return false;
}

void wait_for_debugger(const std::function<bool()>& stop) {
  ::prctl(PR_SET_PTRACER, PR_SET_PTRACER_ANY);
  continued_fd = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  struct sigaction action {
  }, former{};
  action.sa_handler = on_continue;
  ::sigaction(SIGCONT, &action, &former);
  spdlog::info("process {} stands until a debugger is attached, or SIGCONT comes", ::getpid());
  constexpr int kLook_ms = 50;  // that somebody attaches is no event that one could wait for
  pollfd continued{continued_fd, POLLIN, 0};
  while (!stop() && !is_debugged() && ::poll(&continued, 1, kLook_ms) <= 0) {
  }
  ::sigaction(SIGCONT, &former, nullptr);
  ::close(continued_fd.exchange(-1));
}

}  // namespace skein
