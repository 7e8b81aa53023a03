// What a program does to itself when a fault says so. Linux spares the first process of a PID namespace, such as the
// only one of a container, the SIGKILL and SIGSTOP that it raises: it does here what comes nearest to them.
#pragma once

#include <functional>

namespace skein::bus {

/// For a process that is home to several programs: what becomes of one of them instead. Both throw: whoever gives the
/// program its turns catches it, gives no more to one that is killed, and the next to one that stopped when it goes on.
struct SelfSignals {
  std::function<void()> kill, stop;
};
/// Before any program is at work. Empty ones: the process itself, as below.
void set_self_signals(SelfSignals signals);

/// SIGKILL; the first process of its namespace ends at once with the exit code that shells show for one.
[[noreturn]] void kill_ourselves();

/// SIGSTOP; returns when somebody has continued us (SIGCONT). The first process of its namespace sleeps in this call
/// until then: its thread does nothing more, only the middleware's own threads live on.
void stop_ourselves();

}  // namespace skein::bus
