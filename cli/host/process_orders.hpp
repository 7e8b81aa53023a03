// The launcher's part in faults that kill or stop programs: which programs have the order to kill or stop themselves,
// which of them can come back now, and which exits are therefore no failures. sim_server sends each order (status lines
// of type "order"); programs carry it out on themselves (docs/lockstep.md), except users' commands.   Threads: one.
#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/host/program_host.hpp"

namespace skein::cli {

class ProcessOrders {
 public:
  /// @param host  must outlive this.
  explicit ProcessOrders(ProgramHost& host) : host_(host) {}

  /// A fault kills the program, or else stops it. @param by_us  the program obeys no orders: the launcher does it.
  void take_out(const std::string& program, bool kill, bool by_us);
  /// The fault is over: the program comes back as soon as it has died, or the launcher has seen it stop.
  void let_back(const std::string& program);
  /// The programs that can come back by now, once each.
  std::vector<std::string> take_returning();
  /// The program takes part again.
  void returned(const std::string& program) { programs_.erase(program); }
  /// How long to wait for events: a short time while a program has yet to stop, because a stop is no event.
  std::chrono::milliseconds limit(std::chrono::milliseconds limit) const;

  /// A program ended. @returns true when a fault had ordered that.
  bool on_exit(const std::string& program, const ExitStatus& exit);
  /// The run is over: kills the programs that a fault keeps from leaving.
  void end();
  /// The programs that are out of the run now.
  std::set<std::string> out() const;

 private:
  enum class State {
    killed,       ///< has the order, or is dead
    stopped,      ///< has the order, or is stopped
    to_restart,   ///< as soon as it is dead
    to_continue,  ///< as soon as it has stopped
    returning,    ///< runs again, and has not joined yet
    ended         ///< the launcher killed it at the run's end
  };

  ProgramHost& host_;
  std::map<std::string, State> programs_;
};

}  // namespace skein::cli
