// What fault files do to programs, at the launcher's end: who has been told to kill or stop itself, who is to come back
// and can by now, and whose end is therefore none to complain about. sim_server says what and when (status lines of
// type "order"); the victims carry it out on themselves (docs/lockstep.md), except users' commands.   Threads: one.
#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/run/program_host.hpp"

namespace skein::cli {

class ProcessOrders {
 public:
  /// @param host  must outlive this.
  explicit ProcessOrders(ProgramHost& host) : host_(host) {}

  /// The program is killed, or else stopped. @param by_us  it knows no orders: we do it.
  void take_out(const std::string& program, bool kill, bool by_us);
  /// The fault is over: it is to come back as soon as it has died, or has been seen to stand still.
  void let_back(const std::string& program);
  /// Those of whom this is true by now, once each.
  std::vector<std::string> take_returning();
  /// It takes part again.
  void returned(const std::string& program) { programs_.erase(program); }
  /// How long to wait for events: that a program stops is none.
  std::chrono::milliseconds limit(std::chrono::milliseconds limit) const;

  /// A program ended. @returns true when that was ordered.
  bool on_exit(const std::string& program, const ExitStatus& exit);
  /// The run is over: kills whom a fault keeps from leaving.
  void end();
  /// Who is out of the run now.
  std::set<std::string> out() const;

 private:
  enum class State {
    killed,       ///< has been told to, or is dead
    stopped,      ///< the same
    to_restart,   ///< once it is dead
    to_continue,  ///< once it has stopped
    returning,    ///< runs again, and has not joined yet
    ended         ///< killed by us at the run's end
  };

  ProgramHost& host_;
  std::map<std::string, State> programs_;
};

}  // namespace skein::cli
