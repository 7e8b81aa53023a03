// What a program does to itself when a fault says so.
#pragma once

#include <functional>

namespace skein::bus {

/// What becomes of a program instead. In a process that is home to several, both throw: whoever gives the program its
/// turns catches it, gives no more to one that is killed, and the next to one that stopped when it goes on. A program
/// that nobody could continue returns from `stop` at once: it takes no part until it is let back all the same.
struct SelfSignals {
  std::function<void()> kill, stop;
};
/// Before any program is at work. Empty ones: the process itself, as below.
void set_self_signals(SelfSignals signals);

/// SIGKILL. Linux spares the first process of a PID namespace, such as the only one of a container: that one ends at
/// once with the exit code that shells show for it.
[[noreturn]] void kill_ourselves();

/// SIGSTOP; returns when somebody has continued us (SIGCONT). A user's own command (`exec:`) returns at once: the
/// launcher stops it itself, and a second stop, after the launcher's SIGCONT, would be for ever.
void stop_ourselves();

}  // namespace skein::bus
