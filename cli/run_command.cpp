#include "cli/run_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <utility>

#include "cli/oracle_command.hpp"
#include "cli/run/debug_watch.hpp"
#include "cli/run/domain_block.hpp"
#include "cli/run/environment.hpp"
#include "cli/run/fleet_plan.hpp"
#include "cli/run/losses.hpp"
#include "cli/run/preflight.hpp"
#include "cli/run/process_orders.hpp"
#include "cli/run/progress_view.hpp"
#include "cli/run/result.hpp"
#include "cli/run/results_dir.hpp"
#include "cli/secure/security.hpp"
#include "core/suggestion.hpp"
#include "core/wait_notice.hpp"
#include "process/atomic_file.hpp"

namespace skein::cli {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// How long the programs may take to write their reports and leave after sim_server has left.
constexpr milliseconds kLeaveTime{10000};
/// The same for users' commands once all others have left: they need not know that the run is over.
constexpr milliseconds kExecLeaveTime{2000};
/// From SIGTERM to SIGKILL.
constexpr milliseconds kGrace{3000};
/// After Ctrl-C: for sim_server to end the run, and for the programs to leave when it could not end its last step.
constexpr milliseconds kStopTime{8000};
constexpr milliseconds kStalledLeaveTime{1000};
constexpr std::size_t kLogLines = 10;

double seconds_between(Clock::time_point from, Clock::time_point until) {
  return std::chrono::duration<double>(until - from).count();
}

/// One fleet from its start to its last process.
class FleetRun {
 public:
  FleetRun(const FleetPlan& plan, const Console& console)
      : plan_(plan), orders_(supervisor_), view_(console.err, console.terminal) {
    plan_.run = draw_run_id();
    facts_.scenario = plan.options.scenario;
    facts_.seed = plan.options.seed;
    facts_.planners = plan.planners;
    facts_.ground_program = plan.ground;
    facts_.agent = plan.agent;
    facts_.dds = dds_vendors(plan);
    facts_.clock = plan.options.clock;
    facts_.native = plan.options.native;
  }

  /// Starts all programs and returns when none is left.
  void fly(int base_domain, const std::filesystem::path& out, const SecureFolders& secure) {
    for (const ProgramSpec& program : fleet_programs(plan_, base_domain, out, secure)) {
      programs_[program.name] = program;
      supervisor_.start(program);
    }
    if (plan_.options.debug_uav) {
      view_.message("Start the agent of " + *plan_.options.debug_uav + " yourself; the fleet waits for it:\n\n  " +
                    debug_command(plan_, base_domain, out, secure) + "\n");
      debugged_.emplace(*plan_.options.debug_uav, out, agent_file(plan_));
    }
    watch();
    for (const auto& [program, books] :
         {std::pair("station", "station.journal"), {"comm_router", "comm_router.counts"}}) {
      const bool reported =
          reports_.contains(program) || std::filesystem::exists(out / (std::string(program) + ".report.json"));
      if (!reported && std::filesystem::exists(out / books)) settle(program);
    }
    view_.finish();
  }

  RunFacts& facts() { return facts_; }
  ProgressView& view() { return view_; }
  /// What came through the status pipes, by program.
  const std::map<std::string, Json>& reports() const { return reports_; }
  bool anything_failed() const { return failed_; }

 private:
  void watch() {
    while (!supervisor_.running().empty()) {
      milliseconds limit{-1};
      if (leave_by_) {
        limit = std::max(std::chrono::ceil<milliseconds>(*leave_by_ - Clock::now()), milliseconds(0));
        if (limit == milliseconds(0)) {
          end_stragglers();
          continue;
        }
      }
      const bool debugged_ended = debugged_ && debugged_->ended();  // before the news: it may end because the run has
      handle_all(supervisor_.wait(orders_.limit(until_notice(limit))));
      if (debugged_ended) on_debugged_end();
      tell_waiting();
      for (const std::string& program : orders_.take_returning()) bring_back(program);
    }
  }

  /// How long to wait for events at most, so that a word of whom we wait for comes when it is due.
  milliseconds until_notice(milliseconds limit) const {
    milliseconds left = silence_.left(Clock::now());
    if (debugged_) left = std::min(left, DebugWatch::kPeriod);
    return limit.count() < 0 ? left : std::min(limit, left);
  }

  /// The program that the user debugs is lost like any other one.
  void on_debugged_end() {
    if (server_done_ || ending_) return;
    const std::string& uav = *plan_.options.debug_uav;
    view_.message(fmt::format("the debugged program of {} (process {}) has ended; the fleet goes on without it", uav,
                              debugged_->pid()));
    facts_.warnings.push_back("the debugged program of " + uav + " ended before the run did");
    supervisor_.send("sim_server", "lost " + uav);
  }

  /// sim_server says whom the fleet waits for. We do where it says nothing: while it starts, while others leave.
  void tell_waiting() {
    const auto waited_s = silence_.due(Clock::now());
    if (!waited_s || supervisor_.running().empty()) return;
    const std::string whom = server_done_ ? joined(supervisor_.running()) + " to leave" : "sim_server";
    view_.message(fmt::format("waiting for {} ({:.0f} s)", whom, *waited_s));
  }

  void handle_all(const std::vector<Event>& events) {
    for (const Event& event : events) {
      if (event.kind == Event::Kind::status_line) on_status(event);
      if (event.kind == Event::Kind::cut_off) on_cut_off(event);
      if (event.kind == Event::Kind::exited) on_exit(event);
      if (event.kind == Event::Kind::interrupt) on_interrupt();
    }
  }

  void on_status(const Event& event) {
    const Json status = parse_json(event.line);
    if (!status.is_object()) return;
    const Json type = value_or(status, "type", "");
    if (type == "report" && !is_exec(plan_, event.program)) {
      reports_[event.program] = value_or(status, "report", Json::object());
    }
    // A user's command has a status pipe too; what it writes there is no news of the run.
    if (event.program != (type == "tally" ? "station" : "sim_server")) return;
    if (event.program == "sim_server") silence_ = WaitNotice(Clock::now());
    if (type == "waiting_for") {
      view_.waiting_for(status);
      if (first_progress_) facts_.wall_time_s = seconds_between(*first_progress_, Clock::now());
    }
    if (type == "tally") {
      facts_.points_detected = value_or(status, "points", 0);
      facts_.score = value_or(status, "score", 0.0);
      facts_.score_earned = value_or(status, "earned", 0.0);
      view_.tally(status);
    }
    if (type == "order") on_order(status);
    if (type == "warning") view_.message("warning: " + value_or(status, "text", "").get<std::string>());
    if (type == "rejoined") orders_.returned(program_of(value_or(status, "member", "")));
    if (type == "ended") {
      note_use();
      stalled_ = !value_or(status, "stalled", Json::array()).empty();
      server_done_ = true;
      leave_by_ = Clock::now() + leave_time();
    }
    if (type == "progress") {
      facts_.sim_time_s = value_or(status, "t", 0.0);
      facts_.mission_time_s = value_or(status, "mission_s", 0.0);
      if (!first_progress_) on_first_step();
      facts_.wall_time_s = seconds_between(*first_progress_, Clock::now());
      view_.progress(status, facts_.wall_time_s);
    }
  }

  /// A program that writes without end is no longer listened to; it flies on.
  void on_cut_off(const Event& event) {
    facts_.warnings.push_back(event.program + " is not listened to any more: " + event.line);
    view_.message(facts_.warnings.back());
  }

  /// A fault takes a program out of the run, or lets it back.
  void on_order(const Json& status) {
    const std::string program = program_of(value_or(status, "member", "")), order = value_or(status, "order", "");
    const std::string when = fmt::format("at {:.2f} s: ", value_or(status, "t", 0.0).get<double>());
    if (order == "kill" || order == "stop") {
      view_.message(when + "a fault " + order + "s " + program);
      orders_.take_out(program, order == "kill", is_exec(plan_, program));
    } else {
      view_.message(when + program + (order == "start" ? " is started again" : " goes on"));
      orders_.let_back(program);
    }
  }

  /// What was killed starts again, what was stopped goes on.
  void bring_back(const std::string& program) {
    const auto spec = programs_.find(program);
    if (supervisor_.running(program) || spec == programs_.end()) return supervisor_.signal(program, SIGCONT);
    spec->second.append_log = true;
    std::ofstream(spec->second.log, std::ios::app) << "[skein] a fault killed this program; here it starts again\n";
    try {
      supervisor_.start(spec->second);
    } catch (const std::exception& error) {  // the run has a result all the same
      complain(program, std::string("it cannot be started again: ") + error.what());
      supervisor_.send("sim_server", "lost " + member_name(program));
    }
  }

  std::string program_of(const std::string& member) const {
    const auto found = std::find_if(programs_.begin(), programs_.end(),
                                    [&](const auto& entry) { return member_name(entry.first) == member; });
    return found == programs_.end() ? member : found->first;
  }

  /// A program that died left books of what it did: it makes its report of them.
  void settle(const std::string& program) {
    ProgramSpec spec = programs_.at(program);
    spec.argv.push_back("--settle");
    spec.append_log = true;
    try {
      supervisor_.start(spec);
    } catch (const std::exception& error) {
      return complain(program, std::string("its books cannot be settled: ") + error.what());
    }
    const auto take_report = [this](const std::vector<Event>& events) {
      for (const Event& event : events) {
        if (event.kind == Event::Kind::status_line) on_status(event);
      }
    };
    const Clock::time_point deadline = Clock::now() + kLeaveTime;
    while (supervisor_.running(program) && Clock::now() < deadline) take_report(supervisor_.wait(kGrace));
    take_report(supervisor_.end_all(kGrace));
  }

  /// What the programs did before is start-up.
  void on_first_step() {
    first_progress_ = Clock::now();
    facts_.startup_s = seconds_between(started_, *first_progress_);
    for (const std::string& program : supervisor_.running()) cpu_before_s_[program] = supervisor_.cpu_s(program);
  }

  /// What the programs do from here on is leaving.
  void note_use() {
    over_ = true;
    for (const std::string& program : supervisor_.running()) {
      facts_.processes[program].cpu_s += supervisor_.cpu_s(program) - cpu_before_s_[program];
      facts_.processes[program].memory_share_mb = supervisor_.memory_share_mb(program);
    }
  }

  void on_exit(const Event& event) {
    const bool of_server = event.program == "sim_server";
    ProcessUse& use = facts_.processes[event.program];
    use.peak_memory_mb = std::max(use.peak_memory_mb, event.exit.peak_memory_mb);
    if (!over_) use.cpu_s += event.exit.cpu_s - std::exchange(cpu_before_s_[event.program], 0.0);
    if (orders_.on_exit(event.program, event.exit)) return;  // as it should
    if (!event.exit.ok() && !ending_ && !left_as_asked(event.exit)) complain(event.program, event.exit.text());
    if (of_server) {
      facts_.out_by_fault = orders_.out();
      orders_.end();
    }
    if (of_server && !event.exit.ok()) {
      end_all();  // nobody is left to tell the others how the run goes on
    } else if (of_server) {
      server_done_ = true;
      leave_by_ = Clock::now() + leave_time();
    } else if (!ending_ && !server_done_) {
      supervisor_.send("sim_server", "lost " + member_name(event.program));
    }
    if (server_done_ && only_commands_run()) leave_by_ = std::min(*leave_by_, Clock::now() + scaled(kExecLeaveTime));
  }

  /// Who was told that the user ends the run need not find an orderly end to it. A crash is one all the same.
  bool left_as_asked(const ExitStatus& exit) const { return facts_.interrupted && exit.signal == 0; }

  /// For the programs, once sim_server is done. Who never took part in a step does not hear of the end.
  milliseconds leave_time() const {
    if (facts_.interrupted && !first_progress_) return milliseconds(0);
    return scaled(facts_.interrupted && stalled_ ? kStalledLeaveTime : kLeaveTime);
  }

  milliseconds scaled(milliseconds time) const {
    return std::chrono::duration_cast<milliseconds>(time * plan_.options.patience);
  }

  bool only_commands_run() const {
    const std::vector<std::string> running = supervisor_.running();
    return std::all_of(running.begin(), running.end(), [&](const auto& program) { return is_exec(plan_, program); });
  }

  /// First Ctrl-C: the server ends the run at its next step, or in a step that does not end, and all write their reports.
  /// Second: at once.
  void on_interrupt() {
    if (ending_) return;
    if (facts_.interrupted) return end_all();
    facts_.interrupted = true;
    view_.message("ending the run; press Ctrl-C again to end it at once");
    supervisor_.send("sim_server", "stop");
    if (!leave_by_) leave_by_ = Clock::now() + scaled(kStopTime);
  }

  void end_stragglers() {
    for (const std::string& program : supervisor_.running()) {
      if (!is_exec(plan_, program) && !facts_.interrupted) complain(program, "not leaving after the run's end");
    }
    end_all();
  }

  void end_all() {
    if (ending_) return;
    ending_ = true;
    handle_all(supervisor_.end_all(scaled(kGrace)));
  }

  /// Names a program that failed, with the end of its log.
  void complain(const std::string& program, const std::string& how) {
    failed_ = true;
    facts_.warnings.push_back(program + " failed: " + how);
    std::string text = program + " failed: " + how + "; the end of " + programs_.at(program).log.string() + ":";
    for (const std::string& line : last_lines(programs_.at(program).log, kLogLines)) text += "\n    " + line;
    view_.message(text);
  }

  FleetPlan plan_;
  Supervisor supervisor_;
  ProcessOrders orders_;
  ProgressView view_;
  RunFacts facts_;
  std::map<std::string, ProgramSpec> programs_;
  std::map<std::string, Json> reports_;  ///< by program
  const Clock::time_point started_ = Clock::now();
  std::optional<Clock::time_point> first_progress_;
  std::map<std::string, double> cpu_before_s_;  ///< of each program at the first step
  std::optional<Clock::time_point> leave_by_;   ///< whoever runs then is ended
  std::optional<DebugWatch> debugged_;          ///< under --debug
  WaitNotice silence_{Clock::now()};            ///< since sim_server last said something
  bool server_done_ = false;                    ///< sim_server has ended the run in good order
  bool stalled_ = false;                        ///< by Ctrl-C, in a step that somebody never answered
  bool over_ = false;                           ///< the last step is done
  bool ending_ = false;                         ///< the launcher itself ends the programs
  bool failed_ = false;
};

void check_before_flight(const FleetPlan& plan, const Console& console) {
  const auto users = plan.options.secure ? check_agents_access(plan) : nullptr;
  const ScratchDir scratch;
  run_checks(check_programs(plan, scratch.path(), users ? std::optional(users->at(0)) : std::nullopt),
             [&](const std::string& waiting) { console.err << waiting << std::endl; });
}

std::string start_line(const FleetPlan& plan, const DomainBlock& domains, const std::filesystem::path& out) {
  return plan.scenario.name + ": " + std::to_string(plan.scenario.fleet.size()) + " UAVs, planner " +
         plan.options.planner + ", seed " + std::to_string(plan.options.seed) + ", DDS domains " +
         std::to_string(domains.base()) + ".." + std::to_string(domains.last()) + ", results in " + out.string();
}

/// What became of the points; a run is not worth less because of an odd file.
Json losses_of(const std::filesystem::path& dir, const Json& answer, const Reports& reports, Json& warnings) try {
  return write_losses(dir, answer, reports);
} catch (const std::exception& error) {
  warnings.push_back(std::string("no losses.csv: ") + error.what());
  return nullptr;
}

std::string text_of(const Json& result) { return result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// @returns false when the disk refuses; then the result is printed, so that it is not lost.
bool write_result(const ResultsDir& out, const Json& result, std::ostream& err) {
  const std::string trouble = out.write_result(text_of(result));
  if (!trouble.empty()) err << trouble << "; this is what it would have held:\n" << text_of(result) << std::flush;
  return trouble.empty();
}

}  // namespace

int run_fleet(const RunOptions& options, const Console& console) {
  const FleetPlan plan = plan_fleet(options, program_dir());
  const std::filesystem::path dir =
      options.out.value_or(default_results_dir(plan.scenario.name, options.planner, options.seed));
  ResultsDir::check(dir, options.force);
  check_before_flight(plan, console);
  const DomainBlock domains(options.domain, domain_count(plan));
  const ResultsDir out(dir, options.force);

  FleetRun run(plan, console);
  run.view().message(start_line(plan, domains, dir));
  for (const std::string& warning : environment_warnings()) {
    run.view().message("warning: " + warning);
    run.facts().warnings.push_back(warning);
  }
  if (domains.last() > kLastQuietDomain) {
    run.facts().warnings.push_back("DDS domains above " + std::to_string(kLastQuietDomain) +
                                   " use ports that the system may give to other programs");
  }
  std::optional<SecureRun> secure;
  if (options.secure) {
    secure.emplace(plan, domains.base(), out.path());
    for (const std::string& warning : exposed_files(plan)) {
      run.view().message(warning);
      run.facts().warnings.push_back(warning);
    }
  }
  run.fly(domains.base(), out.path(), secure ? secure->folders() : SecureFolders{});

  const Reports reports = read_reports(out.path(), plan.scenario, run.reports());
  Json result = merge_result(run.facts(), plan.scenario, reports);
  // Before all that may still go wrong, or takes room.
  const bool written = write_result(out, result, console.err);
  const std::size_t warnings_written = result["warnings"].size();
  if (secure) {
    for (std::string& warning : secure->collect()) result["warnings"].push_back(std::move(warning));
  }
  secure.reset();
  try {
    if (!write_score_csv(out.path(), reports.station)) result["warnings"].push_back("no scene.json: no score.csv");
  } catch (const std::exception& error) {
    result["warnings"].push_back(std::string("no score.csv: ") + error.what());
  }
  if (options.attainable && result["status"] == "completed") {
    const AttainableAnswer answer = attainable_of(options);
    if (!answer.hint.empty()) result["warnings"].push_back(answer.hint);
    if (answer.attainable.is_object()) {
      result["attainable"] = answer.attainable;
      result["losses"] = losses_of(out.path(), answer.by_point, reports, result["warnings"]);
    }
  }
  const bool news = !result["losses"].is_null() || result["attainable"]["score"].is_number() ||
                    result["warnings"].size() > warnings_written;
  if (written && news) out.write_result(text_of(result));  // the one before stands if the disk is full by now
  print_summary(console.out, result, dir);
  if (!written) return kExitProcessFailed;
  if (run.facts().interrupted) return kExitInterrupted;
  return run.anything_failed() || !result["lost_members"].empty() ? kExitProcessFailed : kExitDone;
}

}  // namespace skein::cli
