#include "cli/run_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <utility>

#include "cli/domain_block.hpp"
#include "cli/fleet_plan.hpp"
#include "cli/oracle_command.hpp"
#include "cli/preflight.hpp"
#include "cli/process_orders.hpp"
#include "cli/progress_view.hpp"
#include "cli/results_dir.hpp"
#include "cli/run_losses.hpp"
#include "cli/run_result.hpp"
#include "cli/security.hpp"
#include "core/atomic_file.hpp"

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
constexpr std::size_t kLogLines = 10;

double seconds_between(Clock::time_point from, Clock::time_point until) {
  return std::chrono::duration<double>(until - from).count();
}

/// One fleet from its start to its last process.
class FleetRun {
 public:
  FleetRun(const FleetPlan& plan, const Console& console)
      : plan_(plan), orders_(supervisor_), view_(console.err, console.terminal) {
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
    }
    watch();
    for (const auto& [program, books] : {std::pair("station", "station.journal"), {"comm_router", "comm_router.counts"}}) {
      const bool reported = std::filesystem::exists(out / (std::string(program) + ".report.json"));
      if (!reported && std::filesystem::exists(out / books)) settle(program);
    }
    view_.finish();
  }

  RunFacts& facts() { return facts_; }
  ProgressView& view() { return view_; }
  bool anything_failed() const { return failed_; }

 private:
  void watch() {
    while (!supervisor_.running().empty()) {
      milliseconds limit{-1};
      if (leave_by_) {
        limit = std::max(std::chrono::ceil<milliseconds>(*leave_by_ - Clock::now()), milliseconds(0));
        if (limit == milliseconds(0)) end_stragglers();
      }
      handle_all(supervisor_.wait(orders_.limit(limit)));
      for (const std::string& program : orders_.take_returning()) bring_back(program);
    }
  }

  void handle_all(const std::vector<Event>& events) {
    for (const Event& event : events) {
      if (event.kind == Event::Kind::status_line) on_status(event);
      if (event.kind == Event::Kind::exited) on_exit(event);
      if (event.kind == Event::Kind::interrupt) on_interrupt();
    }
  }

  void on_status(const Event& event) {
    const Json status = Json::parse(event.line, nullptr, false);
    if (!status.is_object()) return;
    const Json type = value_or(status, "type", "");
    // A user's command has a status pipe too; what it writes there is no news of the run.
    if (event.program != (type == "tally" ? "station" : "sim_server")) return;
    if (type == "waiting_for") view_.waiting_for(status);
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
      if (!leave_by_) leave_by_ = Clock::now() + kLeaveTime;
    }
    if (type == "progress") {
      facts_.sim_time_s = value_or(status, "t", 0.0);
      facts_.mission_time_s = value_or(status, "mission_s", 0.0);
      if (!first_progress_) on_first_step();
      facts_.wall_time_s = seconds_between(*first_progress_, Clock::now());
      view_.progress(status, facts_.wall_time_s);
    }
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
    supervisor_.start(spec->second);
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
    supervisor_.start(spec);
    const Clock::time_point deadline = Clock::now() + kLeaveTime;
    while (supervisor_.running(program) && Clock::now() < deadline) supervisor_.wait(kGrace);
    supervisor_.end_all(kGrace);
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
    if (!event.exit.ok() && !ending_) complain(event.program, event.exit.text());
    if (of_server) {
      facts_.out_by_fault = orders_.out();
      orders_.end();
    }
    if (of_server && !event.exit.ok()) {
      end_all();  // nobody is left to tell the others how the run goes on
    } else if (of_server) {
      leave_by_ = Clock::now() + kLeaveTime;
    } else if (!ending_ && !leave_by_) {
      supervisor_.send("sim_server", "lost " + member_name(event.program));
    }
    if (leave_by_ && only_commands_run()) leave_by_ = std::min(*leave_by_, Clock::now() + kExecLeaveTime);
  }

  bool only_commands_run() const {
    const std::vector<std::string> running = supervisor_.running();
    return std::all_of(running.begin(), running.end(), [&](const auto& program) { return is_exec(plan_, program); });
  }

  /// First Ctrl-C: the server ends the run at its next step and all write their reports. Second: at once.
  void on_interrupt() {
    if (ending_) return;
    if (facts_.interrupted) return end_all();
    facts_.interrupted = true;
    view_.message("ending the run; press Ctrl-C again to end it at once");
    supervisor_.send("sim_server", "stop");
  }

  void end_stragglers() {
    for (const std::string& program : supervisor_.running()) {
      if (!is_exec(plan_, program)) complain(program, "not leaving after the run's end");
    }
    end_all();
  }

  void end_all() {
    if (ending_) return;
    ending_ = true;
    handle_all(supervisor_.end_all(kGrace));
  }

  /// Names a program that failed, with the end of its log.
  void complain(const std::string& program, const std::string& how) {
    failed_ = true;
    facts_.warnings.push_back(program + " failed: " + how);
    std::string text = program + " failed: " + how + "; the end of " + programs_.at(program).log.string() + ":";
    for (const std::string& line : last_lines(programs_.at(program).log, kLogLines)) text += "\n    " + line;
    view_.message(text);
  }

  const FleetPlan& plan_;
  Supervisor supervisor_;
  ProcessOrders orders_;
  ProgressView view_;
  RunFacts facts_;
  std::map<std::string, ProgramSpec> programs_;
  const Clock::time_point started_ = Clock::now();
  std::optional<Clock::time_point> first_progress_;
  std::map<std::string, double> cpu_before_s_;  ///< of each program at the first step
  std::optional<Clock::time_point> leave_by_;   ///< set when sim_server has left in good order
  bool over_ = false;                           ///< the last step is done
  bool ending_ = false;                         ///< the launcher itself ends the programs
  bool failed_ = false;
};

void check_before_flight(const FleetPlan& plan) {
  const auto agent_user = plan.options.secure ? check_agents_access(plan) : std::nullopt;
  const ScratchDir scratch;
  run_checks(check_programs(plan, scratch.path(), agent_user));
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

}  // namespace

int run_fleet(const RunOptions& options, const Console& console) {
  const FleetPlan plan = plan_fleet(options, program_dir());
  const std::filesystem::path dir =
      options.out.value_or(default_results_dir(plan.scenario.name, options.planner, options.seed));
  ResultsDir::check(dir, options.force);
  check_before_flight(plan);
  const DomainBlock domains(options.domain, domain_count(plan));
  const ResultsDir out(dir, options.force);

  FleetRun run(plan, console);
  run.view().message(start_line(plan, domains, dir));
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
  if (secure) secure->collect();
  secure.reset();

  const Reports reports = read_reports(out.path(), plan.scenario);
  Json result = merge_result(run.facts(), plan.scenario, reports);
  const auto write_result = [&] { write_file_atomically(out.path() / "result.json", result.dump(2) + "\n"); };
  write_result();  // before all that may still go wrong
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
    write_result();
  }
  print_summary(console.out, result, dir);
  if (run.facts().interrupted) return kExitInterrupted;
  return run.anything_failed() || !result["lost_members"].empty() ? kExitProcessFailed : kExitDone;
}

}  // namespace skein::cli
