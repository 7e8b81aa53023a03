#include "bus/lockstep/self_signal.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <utility>

namespace skein::bus {
namespace {

/// Environment variable that only a user's own command has (run/exec_variables.cpp).
constexpr const char* kExecVariable = "SKEIN_UAV";

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
  if (std::getenv(kExecVariable) != nullptr) return;  // the launcher stops it, and may have continued it already
  std::raise(SIGSTOP);
}

}  // namespace skein::bus
