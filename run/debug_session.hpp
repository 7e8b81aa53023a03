// The debugged programs of a run (--debug): prints how to attach to them, writes the fleet's progress to a file while a
// debugger has the terminal, and notices when a debugged program ends. A run without --debug has a session without
// programs, in which every function does nothing.   Threads: one.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "debug/debug_watch.hpp"
#include "run/fleet_plan.hpp"
#include "run/progress_view.hpp"

namespace skein::cli {

class DebugSession {
 public:
  /// Create it before the programs start. @param plan, view, console  must outlive this.
  /// @param debuggees  the programs to watch. @param terminal  `console` can rewrite its last line.
  DebugSession(const FleetPlan& plan, const std::vector<Debuggee>& debuggees, int base_domain,
               const std::filesystem::path& out, const SecureFolders& secure, ProgressView& view, std::ostream& console,
               bool terminal);
  ~DebugSession();
  DebugSession(const DebugSession&) = delete;
  DebugSession& operator=(const DebugSession&) = delete;

  /// Whether it watches programs.
  bool watches() const { return !watches_.empty(); }
  /// The longest time from one call of take_ended() to the next.
  std::chrono::milliseconds period() const {
    return watches() ? DebugWatch::kPeriod : std::chrono::milliseconds::max();
  }
  /// Looks for debugged processes that have started or ended. @returns those that have ended since the
  /// last call; their tools may still run.
  std::vector<const DebugWatch*> take_ended();
  /// Waits for debugged processes, for each at most `timeout`, since they may still be writing their reports: as
  /// they are not children of the launcher, it gets no event at their end.
  void await_reports(std::chrono::milliseconds timeout) const;
  /// The watch of a program; null: it is not debugged.
  const DebugWatch* find(const std::string& program) const;
  /// Notes that a program has ended before the run did. @returns false: that was noted already.
  bool lose(const std::string& program) { return lost_.insert(program).second; }
  bool is_lost(const std::string& program) const { return lost_.contains(program); }
  /// Takes back lose(). @returns false: it was not noted.
  bool take_back(const std::string& program) { return lost_.erase(program) > 0; }
  /// The program starts again after a fault, under its tool, which may need the terminal again. It is no longer lost.
  void on_restart(const std::string& program);
  /// A program or its tool has ended: if it had the terminal, progress goes to the console again.
  void on_exit(const std::string& program);

 private:
  std::string introduction(const FleetPlan& plan, const Debuggee& debuggee, int base_domain,
                           const std::filesystem::path& out, const SecureFolders& secure) const;

  const FleetPlan& plan_;
  ProgressView& view_;
  std::ostream& console_;
  const bool terminal_;
  const std::filesystem::path log_file_;
  std::ofstream log_;
  std::vector<std::unique_ptr<DebugWatch>> watches_;
  std::set<std::string> lost_;  ///< programs that have ended before the run did
};

}  // namespace skein::cli
