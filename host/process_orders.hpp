// The launcher's part in faults that kill or stop programs: records which programs were ordered to kill or stop
// themselves, which of them can come back now, and which exits are therefore no failures. sim_server sends each order
// (a status line of type "order"); a program carries it out itself (docs/lockstep.md), but not a user's command.
// Threads: one.
#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/program_host.hpp"

namespace skein::cli {

class ProcessOrders {
 public:
  /// @param host  must outlive this.
  explicit ProcessOrders(ProgramHost& host) : host_(host) {}

  /// A fault kills the program (`kill`) or stops it.
  /// @param by_us  the program does not obey orders (a user's command), so the launcher sends the signal.
  void take_out(const std::string& program, bool kill, bool by_us);
  /// The fault is over: the program may come back as soon as it has died, or the launcher has seen it stop.
  void let_back(const std::string& program);
  /// Programs that can be restarted or continued now; reports each only once.
  std::vector<std::string> take_returning();
  /// The program has joined the lock-step again.
  void returned(const std::string& program) { programs_.erase(program); }
  /// Shortens a wait for events (negative: endless) while a program that is to be continued has not stopped yet, since
  /// ProgramHost reports no event when a program stops.
  std::chrono::milliseconds limit(std::chrono::milliseconds limit) const;

  /// A program ended. @returns true if SIGKILL ended it and a fault or end() had ordered that: it is not a failure.
  bool on_exit(const std::string& program, const ExitStatus& exit);
  /// The run is over: kills all programs that a fault still keeps out of it, since they cannot end by themselves.
  void end();
  /// Programs that are out of the run now: from take_out() until they have joined again.
  std::set<std::string> out() const;

 private:
  enum class State {
    killed,       ///< has the order to kill itself, or is dead
    stopped,      ///< has the order to stop itself, or is stopped
    to_restart,   ///< the fault is over: restart it as soon as it is dead
    to_continue,  ///< the fault is over: continue it as soon as it has stopped
    returning,    ///< runs again, but has not joined the lock-step yet
    ended         ///< the launcher killed it at the run's end
  };

  ProgramHost& host_;
  std::map<std::string, State> programs_;
};

}  // namespace skein::cli
