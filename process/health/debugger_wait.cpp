#include "process/health/debugger_wait.hpp"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

namespace skein {
namespace {

/// The eventfd with which the SIGCONT handler ends the wait; -1: none.
std::atomic<int> continued_fd = -1;

extern "C" void on_continue(int) { ::eventfd_write(continued_fd, 1); }

/// Whether a thread of this process sleeps in a system call.
bool sleeps(pid_t thread) {
  std::ifstream in("/proc/self/task/" + std::to_string(thread) + "/stat");
  const std::string stat{std::istreambuf_iterator<char>(in), {}};
  const std::size_t name_end = stat.rfind(')');  // the state follows the name, which may contain anything
  return name_end != std::string::npos && stat.substr(name_end).starts_with(") S");
}

/// Detects a debugger even if it attaches and detaches again, of which Linux keeps no record. A debugger stops all
/// threads; when they continue, epoll_wait(), unlike poll(), fails with EINTR. A thread that also does other things
/// could be stopped outside that call and miss the debugger. So this thread stays in the call, all signals blocked.
class AttachWatch {
 public:
  /// After this constructor returns, no debugger is missed. @param noticed_fd  an eventfd; gets 1 when a debugger has
  /// stopped and continued this process.
  explicit AttachWatch(int noticed_fd) : noticed_fd_(noticed_fd), thread_([this] { watch(); }) {
    constexpr int kLook_ms = 1;
    pollfd noticed{.fd = noticed_fd_, .events = POLLIN, .revents = 0};  // readable: a debugger came at once
    while ((thread_id_ == 0 || !sleeps(thread_id_)) && ::poll(&noticed, 1, kLook_ms) <= 0) {
    }
  }
  ~AttachWatch() {
    ::eventfd_write(end_fd_, 1);
    thread_.join();
    ::close(end_fd_);
  }
  AttachWatch(const AttachWatch&) = delete;
  AttachWatch& operator=(const AttachWatch&) = delete;

 private:
  void watch() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
    const int waiting = ::epoll_create1(EPOLL_CLOEXEC);
    epoll_event event{};
    event.events = EPOLLIN;
    ::epoll_ctl(waiting, EPOLL_CTL_ADD, end_fd_, &event);
    thread_id_ = ::gettid();  // from now on the thread sleeps only in epoll_wait()
    if (::epoll_wait(waiting, &event, 1, -1) < 0 && errno == EINTR) ::eventfd_write(noticed_fd_, 1);
    ::close(waiting);
  }

  int noticed_fd_;
  int end_fd_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  std::atomic<pid_t> thread_id_ = 0;
  std::thread thread_;  // last, because it uses the other members
};

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
  {
    const AttachWatch watch(continued_fd);
    spdlog::info("process {} waits for a debugger or SIGCONT", ::getpid());
    constexpr int kLook_ms = 50;
    pollfd continued{.fd = continued_fd, .events = POLLIN, .revents = 0};
    // A tracer that attaches to this thread only (strace -p) is detected only while it is attached.
    while (!stop() && !is_debugged() && ::poll(&continued, 1, kLook_ms) <= 0) {
    }
  }
  ::sigaction(SIGCONT, &former, nullptr);
  ::close(continued_fd.exchange(-1));
}

}  // namespace skein
