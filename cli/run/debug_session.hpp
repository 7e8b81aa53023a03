// What of a run the user looks into: tells him how, lets a debugger have the terminal while the fleet's progress goes
// to a file, and says whose program has ended.   Threads: one.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "cli/debug/debug_watch.hpp"
#include "cli/run/fleet_plan.hpp"
#include "cli/run/progress_view.hpp"

namespace skein::cli {

class DebugSession {
 public:
  /// Before the programs start. @param plan, view, console  must outlive this. @param terminal  of the console
  DebugSession(const FleetPlan& plan, int base_domain, const std::filesystem::path& out, const SecureFolders& secure,
               ProgressView& view, std::ostream& console, bool terminal);
  ~DebugSession();
  DebugSession(const DebugSession&) = delete;
  DebugSession& operator=(const DebugSession&) = delete;

  /// Looks after them. @returns those that have ended since, while their tool may live on.
  std::vector<const DebugWatch*> take_ended();
  /// What the user started himself is no child of ours: at the end it may still be about to leave its report.
  void await_reports(std::chrono::milliseconds timeout) const;
  /// Of a program; null: nobody looks into it.
  const DebugWatch* find(const std::string& program) const;
  /// It starts again after a fault, below its tool.
  void on_restart(const std::string& program);
  /// A program, or the tool that it was below, has ended: the terminal may be ours again.
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
