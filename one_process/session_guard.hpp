// Watches over a process whose only thread works for somebody else: when that program has gone, so does this one,
// whatever it is about; and a turn without an end is given up. By a timer's signal, not by a thread: a process is to be
// copied with all that it has, and fork() takes along the thread that calls it alone.
// Linux.   Threads: one.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace skein::one_process {

class SteppedFleet;

class SessionGuard {
 public:
  /// @param patience_s  wall time that a program may take for one turn; 0: for ever.
  explicit SessionGuard(double patience_s);
  SessionGuard(const SessionGuard&) = delete;
  SessionGuard& operator=(const SessionGuard&) = delete;

  /// Begins, also in a copy of this process. @param socket  its other end is that program's
  void watch(int socket);
  /// Whose turns it looks after; null: nobody's. What it refers to must live until it is told otherwise.
  void look_after(const SteppedFleet* fleet);
};

}  // namespace skein::one_process
