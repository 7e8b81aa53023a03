#include "bus/lockstep/self_signal.hpp"

#include <semaphore.h>
#include <unistd.h>

#include <csignal>
#include <utility>

namespace skein::bus {
namespace {

/// Posted by the handler of SIGCONT, which may run on any thread and can reach nothing but a global.
sem_t continued;

extern "C" void on_continued(int) { ::sem_post(&continued); }

SelfSignals& instead() {
  static SelfSignals signals;
  return signals;
}

}  // namespace

void set_self_signals(SelfSignals signals) { instead() = std::move(signals); }

void kill_ourselves() {
  if (instead().kill) instead().kill();
  std::raise(SIGKILL);
  ::_exit(128 + SIGKILL);
}

void stop_ourselves() {
  if (instead().stop) return instead().stop();
  if (::getpid() != 1) {
    std::raise(SIGSTOP);
    return;
  }
  ::sem_init(&continued, 0, 0);
  struct sigaction action {
  }, before{};
  action.sa_handler = on_continued;
  ::sigaction(SIGCONT, &action, &before);
  while (::sem_wait(&continued) != 0) {
    // another signal
  }
  ::sigaction(SIGCONT, &before, nullptr);
  ::sem_destroy(&continued);
}

}  // namespace skein::bus
