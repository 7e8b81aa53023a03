// The debugged programs of a run (--debug): prints how to attach to them, writes the fleet's progress to a file while a
// debugger has the terminal, and notices when a debugged program ends.   Threads: one.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "debug/debug_watch.hpp"
#include "run/fleet_plan.hpp"
#include "run/progress_view.hpp"

namespace skein::cli {

class DebugSession {
 public:
  /// Create it before the programs start. @param plan, view, console  must outlive this.
  /// @param terminal  `console` can rewrite its last line.
  DebugSession(const FleetPlan& plan, int base_domain, const std::filesystem::path& out, const SecureFolders& secure,
               ProgressView& view, std::ostream& console, bool terminal);
  ~DebugSession();
  DebugSession(const DebugSession&) = delete;
  DebugSession& operator=(const DebugSession&) = delete;

  /// Call it often: looks for debugged processes that have started or ended. @returns those that have ended since the
  /// last call; their tools may still run.
  std::vector<const DebugWatch*> take_ended();
  /// Waits for debugged processes, for each at most `timeout`, since they may still be writing their reports: as
  /// they are not children of the launcher, it gets no event at their end.
  void await_reports(std::chrono::milliseconds timeout) const;
  /// The watch of a program; null: it is not debugged.
  const DebugWatch* find(const std::string& program) const;
  /// The program starts again after a fault, under its tool, which may need the terminal again.
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
};

}  // namespace skein::cli
