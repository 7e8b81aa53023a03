#include "process/debugger_wait.hpp"

#include <spdlog/spdlog.h>
#include <sys/epoll.h>
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
  const int waiting = ::epoll_create1(EPOLL_CLOEXEC);
  epoll_event event{};
  event.events = EPOLLIN;
  ::epoll_ctl(waiting, EPOLL_CTL_ADD, continued_fd, &event);
  // A debugger that attaches stops us, and epoll_wait, unlike poll, fails with EINTR when we go on: so we know of one
  // that has left again. One that came between two waits is seen here while it stays.
  constexpr int kLook_ms = 50;
  int ready = 0;
  while (!stop() && !is_debugged() && ready == 0) ready = ::epoll_wait(waiting, &event, 1, kLook_ms);
  ::close(waiting);
  ::sigaction(SIGCONT, &former, nullptr);
  ::close(continued_fd.exchange(-1));
}

}  // namespace skein
