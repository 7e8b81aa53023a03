// How a program kills or stops itself when a fault requires it.
#pragma once

#include <functional>

namespace skein::bus {

/// Replacements for the signals. In a process with several programs, both functions throw. The caller that gives the
/// program its turns catches the exception: a killed program gets no further turns, a stopped one none until it is
/// continued. For a program without a launcher that could continue it, `stop` returns at once: the program asks to join
/// again, and the server lets it join when the fault ends.
struct SelfSignals {
  std::function<void()> kill, stop;
};
/// Call it before any program runs. Empty functions: signals to the process itself, as below.
void set_self_signals(SelfSignals signals);

/// Raises SIGKILL. Linux ignores it for the first process of a PID namespace, such as the only process of a container:
/// that process exits at once with the exit code that shells show for SIGKILL, 137.
[[noreturn]] void kill_ourselves();

/// Raises SIGSTOP; returns when the process is continued (SIGCONT). In a user's own command (`exec:`) it returns at
/// once: the launcher stops such a command itself, and a second SIGSTOP, after the launcher's SIGCONT, would never end.
void stop_ourselves();

}  // namespace skein::bus
