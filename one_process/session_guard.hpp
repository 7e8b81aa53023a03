// Watches the process of a session, which has a single thread. It ends the process when the program that steps the
// fleet has closed its end of the socket, or when a turn takes too long. It uses the signal of a timer instead of a
// thread, because sessions are copied by fork(), which copies only the calling thread.
// Linux.   Threads: one.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace skein::one_process {

class SteppedFleet;

class SessionGuard {
 public:
  /// @param patience_s  wall time that a program may take for one turn; 0: no limit.
  explicit SessionGuard(double patience_s);
  SessionGuard(const SessionGuard&) = delete;
  SessionGuard& operator=(const SessionGuard&) = delete;

  /// Starts the timer; call it again in a copy of the process. @param socket  the socket to the program that steps the
  /// fleet @throws std::system_error
  void watch(int socket);
  /// Sets the fleet whose turns are watched; null: none. It must live until the next call.
  void look_after(const SteppedFleet* fleet);
};

}  // namespace skein::one_process
