// Runs one fleet from the start of its programs to the end of the last one: reads their status lines, tells sim_server
// which programs are lost, executes faults that concern programs, and ends programs that do not leave by themselves.
// Threads: everything from one thread, which must live as long as the programs (see supervisor.hpp).
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/run/wait_notice.hpp"
#include "host/domain_block.hpp"
#include "host/process_orders.hpp"
#include "host/program_host.hpp"
#include "process/status/status_lines.hpp"
#include "results/result.hpp"
#include "run/debug_session.hpp"
#include "run/fleet_plan.hpp"
#include "run/leave_deadline.hpp"
#include "run/progress_view.hpp"

namespace skein::cli {

/// The signal by which a container's follower (cli/compose/followers.hpp) ends if the Docker engine does not tell how
/// the container ended. It is a signal because a container may end with any exit code.
inline constexpr int kEngineLost = SIGUSR2;

class FleetRun {
 public:
  /// @param out  receives progress and messages; must outlive this. @param terminal  `out` can rewrite its last line.
  FleetRun(const FleetPlan& plan, std::ostream& out, bool terminal);

  /// Starts all programs and returns when all have ended. Call it once.
  /// @param elsewhere  runs the programs, for example on other hosts; null: they are children of this process.
  void fly(int base_domain, const std::filesystem::path& out, const SecureFolders& secure,
           std::unique_ptr<ProgramHost> elsewhere = nullptr);

  /// The domains that the fleet uses, as long as fly() lasts. They must outlive fly().
  void tend(const DomainBlock& domains) { domains_ = &domains; }

  /// The same for programs in containers, which are restarted there and not by the launcher. So this process does not
  /// execute faults that concern programs. @param containers  the follower process of each container.
  void fly_in_containers(const std::vector<ProgramSpec>& containers, const std::filesystem::path& out);

  /// The launcher's knowledge of the run so far, for the run's result.
  results::RunFacts& facts() { return facts_; }
  ProgressView& view() { return view_; }
  /// The reports that came through the status pipes, by program.
  const std::map<std::string, Json>& reports() const { return reports_; }
  bool anything_failed() const { return failed_ || !failed_programs_.empty(); }

 private:
  using Clock = std::chrono::steady_clock;
  using milliseconds = std::chrono::milliseconds;

  void start(const std::vector<ProgramSpec>& programs);
  void finish(const std::filesystem::path& out);

  // Following the run.
  void watch();
  milliseconds until_notice(milliseconds limit) const;
  void handle_all(const std::vector<Event>& events);
  void on_status(const Event& event);
  void on_cut_off(const Event& event);
  void on_exit(Event event);
  void on_interrupt();
  void on_engine_lost();
  void tell_waiting();

  // Programs under --debug (fleet_debug.cpp).
  void on_debugged_exit(Event& event);
  void on_debugged_end(const DebugWatch& watch);
  bool being_debugged() const;

  // News from sim_server and the station.
  void hear(const status::Progress& progress);
  void hear(const status::Tally& tally);
  void hear(const status::WaitingFor& wait);
  void hear(const status::Order& order);
  void hear(const status::Warning& warning) { view_.message("warning: " + warning.text); }
  void hear(const status::Rejoined& rejoined);
  void hear(const status::Ended& ended);
  void hear(const status::Report&) {}

  // Reactions of the launcher.
  void bring_back(const std::string& program);
  void settle(const std::string& program);
  void tell_lost(const std::string& member);
  void end_stragglers();
  void end_all();
  std::string crash_text(const std::string& program, const ExitStatus& exit);
  void complain(const std::string& program, const std::string& how);

  std::string program_of(const std::string& member) const;
  bool left_as_asked(const ExitStatus& exit) const;
  milliseconds leave_time() const;
  milliseconds scaled(milliseconds time) const;
  bool only_commands_run() const;

  // CPU time and memory of the programs between the first step and the last.
  void on_first_step();
  void note_use();
  void note_end(const Event& event);

  FleetPlan plan_;
  std::ostream& console_;
  const bool terminal_;
  const DomainBlock* domains_ = nullptr;  ///< null: none, or of another process
  std::unique_ptr<ProgramHost> host_;
  std::optional<ProcessOrders> orders_;
  ProgressView view_;
  results::RunFacts facts_;
  std::map<std::string, ProgramSpec> programs_;
  std::map<std::string, Json> reports_;  ///< by program
  const Clock::time_point started_ = Clock::now();
  std::optional<Clock::time_point> first_progress_;
  std::map<std::string, double> cpu_before_s_;  ///< of each process at the first step
  LeaveDeadline leave_by_;                      ///< the launcher then ends all programs that still run
  std::optional<DebugSession> debug_;           ///< set before the programs start
  WaitNotice silence_{Clock::now()};            ///< since sim_server last said something
  bool in_containers_ = false;
  bool server_done_ = false;  ///< sim_server has ended the run in good order
  bool stalled_ = false;      ///< Ctrl-C ended the run in a step that a program never answered
  bool over_ = false;         ///< the last step is done
  bool ending_ = false;       ///< the launcher itself ends the programs
  bool failed_ = false;
  std::set<std::string> failed_programs_;  ///< without those that have rejoined
};

}  // namespace skein::cli
