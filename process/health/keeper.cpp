#include "process/health/keeper.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <iostream>
#include <system_error>

namespace skein {
namespace {

constexpr std::array kPassedOn = {SIGTERM, SIGINT, SIGHUP};

/// Blocks the signals for which the keeper waits, as long as this object exists. Blocked signals stay pending, even for
/// the first process of a PID namespace, which otherwise gets no signal that it does not handle.
class WaitedForSignals {
 public:
  WaitedForSignals() {
    ::sigemptyset(&all_);
    ::sigaddset(&all_, SIGCHLD);
    for (const int signal : kPassedOn) ::sigaddset(&all_, signal);
    ::sigprocmask(SIG_BLOCK, &all_, &before_);
  }
  ~WaitedForSignals() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
  WaitedForSignals(const WaitedForSignals&) = delete;
  WaitedForSignals& operator=(const WaitedForSignals&) = delete;

  siginfo_t wait() const {
    siginfo_t info{};
    while (::sigwaitinfo(&all_, &info) < 0 && errno == EINTR) {
    }
    return info;
  }

 private:
  sigset_t all_{}, before_{};
};

/// The worker's exit status; nullopt: it has not ended. Also reaps orphans, which the first process of a container
/// inherits.
std::optional<int> status_of(pid_t worker) {
  int status = 0;
  for (pid_t ended = 0; (ended = ::waitpid(-1, &status, WNOHANG)) > 0;) {
    if (ended == worker) return status;
  }
  return std::nullopt;
}

/// Waits for the worker's end. @returns its exit status. @param asked_to_end  set if the keeper is asked to end.
int watch(pid_t worker, const WaitedForSignals& signals, bool& asked_to_end) {
  while (true) {
    const siginfo_t info = signals.wait();
    if (info.si_signo == SIGCHLD) {
      if (const auto status = status_of(worker)) return *status;
      continue;
    }
    asked_to_end = true;
    if (info.si_code != SI_KERNEL) ::kill(worker, info.si_signo);  // a terminal sends Ctrl-C to both processes
  }
}

}  // namespace

std::optional<int> keep_alive(int& lives) {
  const pid_t keeper = ::getpid();
  const WaitedForSignals signals;
  for (bool asked_to_end = false;;) {
    ++lives;
    const pid_t worker = ::fork();
    if (worker < 0) throw std::system_error(errno, std::generic_category(), "no process for the program itself");
    if (worker == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != keeper) ::_exit(128 + SIGKILL);  // the keeper died before prctl()
      return std::nullopt;
    }
    const int status = watch(worker, signals, asked_to_end);
    if (WIFEXITED(status)) return WEXITSTATUS(status);
    if (WTERMSIG(status) != SIGKILL || asked_to_end) return 128 + WTERMSIG(status);
    std::cerr << "[skein] this program was killed; here it starts again" << std::endl;
  }
}

}  // namespace skein
