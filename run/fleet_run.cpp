#include "run/fleet_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <variant>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "debug/crash_trace.hpp"
#include "host/shared_process.hpp"
#include "host/supervisor.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_programs.hpp"
#include "run/python_planners.hpp"

namespace skein::cli {
namespace {

using std::chrono::milliseconds;
/// Time in which the programs must write their reports and leave after sim_server has left. Beside many other busy
/// programs, with a low priority, they need over 10 s.
constexpr milliseconds kLeaveTime{30000};
/// Additional time for each UAV, whose program writes its map: in one process, the programs take turns.
constexpr milliseconds kLeaveTimePerUav{200};
/// The same for users' commands once all others have left: they need not know that the run is over.
constexpr milliseconds kExecLeaveTime{2000};
/// From SIGTERM to SIGKILL.
constexpr milliseconds kGrace{3000};
constexpr double kUsualPatience_s = 60.0;  // for one turn of a program
/// After Ctrl-C: time for sim_server to end the run, and for the programs to leave, also if the last step never ended.
constexpr milliseconds kStopTime{8000};
constexpr milliseconds kStoppedLeaveTime{10000};
constexpr milliseconds kStalledLeaveTime{1000};
constexpr std::size_t kLogLines = 10;

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point until) {
  return std::chrono::duration<double>(until - from).count();
}

}  // namespace

FleetRun::FleetRun(const FleetPlan& plan, std::ostream& out, bool terminal)
    : plan_(plan), console_(out), terminal_(terminal), view_(out, terminal) {
  plan_.run = draw_run_id();
  facts_.command = plan.options.command;
  // SKEIN_AGENT named the agent: the command must repeat the run where this variable is not set.
  if (!facts_.command.empty() && plan.agent && !plan.options.agent) {
    facts_.command += " --agent " + shell_word(plan.agent->string());
  }
  facts_.scenario = plan.options.scenario;
  facts_.seed = plan.options.seed;
  for (const UavPlanner& planner : plan.planners) {
    facts_.planners.push_back(takes_part(plan, planner.uav) ? planner : UavPlanner{planner.uav, kRecorded});
  }
  if (takes_part(plan, "gcs")) facts_.ground_program = plan.ground;
  facts_.agent = plan.agent;
  facts_.dds = dds_vendors(plan);
  facts_.clock = plan.options.clock;
  facts_.native = plan.options.native;
}

void FleetRun::fly(int base_domain, const std::filesystem::path& out, const SecureFolders& secure,
                   std::unique_ptr<ProgramHost> elsewhere) {
  facts_.planner_files = keep_python_files(plan_.planners, out, facts_.warnings);
  if (plan_.options.one_process) {
    programs_[programs::kOneProcess] = shared_process(plan_, out);
    host_ = std::make_unique<SharedProcess>(programs_[programs::kOneProcess],
                                            plan_.options.agent_timeout_s.value_or(kUsualPatience_s));
  } else {
    host_ = elsewhere ? std::move(elsewhere) : std::make_unique<Supervisor>();
  }
  debug_.emplace(plan_, plan_.debug, base_domain, out, secure, view_, console_, terminal_);
  start(fleet_programs(plan_, base_domain, out, secure));
  finish(out);
}

void FleetRun::fly_in_containers(const std::vector<ProgramSpec>& containers, const std::filesystem::path& out) {
  facts_.planner_files = keep_python_files(plan_.planners, out, facts_.warnings);
  in_containers_ = true;
  host_ = std::make_unique<Supervisor>();
  const bool any_here = std::ranges::any_of(plan_.debug, &Debuggee::here);
  debug_.emplace(plan_, any_here ? plan_.debug : std::vector<Debuggee>{}, kFirstDomain, out, SecureFolders{}, view_,
                 console_, terminal_);
  start(containers);
  finish(out);
}

void FleetRun::start(const std::vector<ProgramSpec>& programs) {
  orders_.emplace(*host_);
  for (const ProgramSpec& program : programs) {
    programs_[program.name] = program;
    host_->start(program);
  }
}

void FleetRun::finish(const std::filesystem::path& out) {
  watch();
  if (server_done_) debug_->await_reports(leave_time());
  // From here on programs start on this host and without a debugger: see settle().
  if (in_containers_ || (debug_->watches() && !plan_.options.secure)) {
    plan_.debug.clear();
    for (ProgramSpec& program : fleet_programs(plan_, kFirstDomain, out)) {
      programs_[program.name] = std::move(program);
    }
  }
  for (const auto& [program, books] :
       {std::pair(programs::kStation, run_folder::kJournal), {programs::kCommRouter, run_folder::kCounts}}) {
    const bool reported = reports_.contains(program) || std::filesystem::exists(out / run_folder::report_file(program));
    if (!reported && std::filesystem::exists(out / books)) settle(program);
  }
  handle_all(host_->end_all(scaled(kGrace)));  // under --one-process, the shared process still runs
  for (std::string& warning : host_->collect(out)) facts_.warnings.push_back(std::move(warning));
  view_.finish();
}

// ---- following the run ------------------------------------------------------------------------------------------

void FleetRun::watch() {
  while (!host_->running().empty()) {
    const Clock::time_point began = Clock::now();
    milliseconds limit = leave_by_.is_set() && !being_debugged() ? leave_by_.left() : milliseconds(-1);
    if (limit == milliseconds(0)) {
      end_stragglers();
      continue;
    }
    limit = orders_->limit(until_notice(limit));
    // Looks before wait(): if they ended because the run did, wait() returns the news of that before their end is
    // handled.
    const auto debugged_ended = debug_->take_ended();
    handle_all(host_->wait(limit));
    for (const DebugWatch* watch : debugged_ended) on_debugged_end(*watch);
    host_->follow_job_control();
    tell_waiting();
    if (domains_ != nullptr) domains_->forget_visitors();
    for (const std::string& program : orders_->take_returning()) bring_back(program);
    leave_by_.excuse(Clock::now() - began, limit);
  }
}

/// Longest wait for events, so that tell_waiting() prints its notice in time, and debugged programs are looked for.
milliseconds FleetRun::until_notice(milliseconds limit) const {
  const milliseconds left = std::min(silence_.left(Clock::now()), debug_->period());
  return limit.count() < 0 ? left : std::min(limit, left);
}

void FleetRun::handle_all(const std::vector<Event>& events) {
  for (const Event& event : events) {
    if (event.kind == Event::Kind::status_line) on_status(event);
    if (event.kind == Event::Kind::cut_off) on_cut_off(event);
    if (event.kind == Event::Kind::exited) on_exit(event);
    if (event.kind == Event::Kind::interrupt) on_interrupt();
  }
}

void FleetRun::on_status(const Event& event) {
  const std::optional<status::Line> line = status::read_line(event.line);
  if (!line) return;
  const auto* report = std::get_if<status::Report>(&*line);
  if (report != nullptr && !is_exec(plan_, event.program)) reports_[event.program] = report->report;
  // A user's command has a status pipe too; what it writes there is no news of the run.
  const bool is_tally = std::holds_alternative<status::Tally>(*line);
  if (event.program != (is_tally ? programs::kStation : programs::kSimServer)) return;
  if (!is_tally) silence_ = WaitNotice(Clock::now());
  std::visit([this](const auto& news) { hear(news); }, *line);
}

/// The status pipe of a program that writes too much is closed; the program flies on.
void FleetRun::on_cut_off(const Event& event) {
  facts_.warnings.push_back(event.program + ": Skein reads no further status from it: " + event.line);
  view_.message(facts_.warnings.back());
}

void FleetRun::on_exit(Event event) {
  if (in_containers_ && event.exit.signal == kEngineLost) return on_engine_lost();
  const bool of_server = event.program == programs::kSimServer;
  note_end(event);
  const DebugWatch* debugged = debug_->find(event.program);
  if (debugged != nullptr) on_debugged_exit(event);
  if (orders_->on_exit(event.program, event.exit)) return;  // as a fault ordered
  if (debugged != nullptr && debugged->debuggee().here && !event.exit.ok()) return on_debugged_end(*debugged);
  if (debug_->is_lost(event.program)) return;
  if (!event.exit.ok() && !event.exit.dragged && !ending_ && !left_as_asked(event.exit)) {
    complain(event.program, event.exit.text() + crash_text(event.program, event.exit));
  }
  if (of_server) {
    facts_.out_by_fault = orders_->out();
    orders_->end();
  }
  if (of_server && !event.exit.ok()) {
    end_all();  // the other programs would wait for it in vain
  } else if (of_server) {
    server_done_ = true;
    leave_by_.set(leave_time());
  } else if (!ending_ && !server_done_) {
    tell_lost(programs::member_name(event.program));
  }
  if (server_done_ && only_commands_run()) leave_by_.bring_forward(scaled(kExecLeaveTime));
}

/// Without the Docker engine, the launcher neither knows the state of the containers nor can end them.
void FleetRun::on_engine_lost() {
  if (anything_failed() && ending_) return;  // all followers notice, one after the other
  failed_ = true;
  facts_.warnings.push_back("the Docker engine does not answer any more, so the state of the containers is not known");
  view_.message(facts_.warnings.back() + "; the run ends here");
  end_all();
}

/// First Ctrl-C: sim_server ends the run at its next step, also if the present step never ends, and all programs write
/// their reports. Second Ctrl-C: the launcher ends all programs at once.
void FleetRun::on_interrupt() {
  if (ending_) return;
  if (facts_.interrupted) return end_all();
  facts_.interrupted = true;
  view_.message("ending the run; press Ctrl-C again to end it at once");
  if (in_containers_) {
    host_->signal(programs::kSimServer, SIGTERM);
  } else {
    host_->send(programs::kSimServer, orders::text_of(orders::Stop{}));
  }
  if (!leave_by_.is_set()) leave_by_.set(scaled(kStopTime));
}

/// Prints what the launcher waits for while sim_server reports nothing: while it starts, and while programs leave.
void FleetRun::tell_waiting() {
  const auto waited_s = silence_.due(Clock::now());
  if (!waited_s || host_->running().empty()) return;
  const std::string whom = server_done_ ? joined_first(host_->running()) + " to leave" : programs::kSimServer;
  view_.message(fmt::format("waiting for {} ({:.0f} s)", whom, *waited_s));
}

// ---- news from sim_server and the station -----------------------------------------------------------------------

void FleetRun::hear(const status::Rejoined& rejoined) {
  orders_->returned(program_of(rejoined.member));
  if (failed_programs_.erase(program_of(rejoined.member)) > 0) {
    view_.message(rejoined.member + " was started again by hand, and takes part again");
  }
}

void FleetRun::hear(const status::Progress& progress) {
  facts_.sim_time_s = progress.time_s;
  facts_.mission_time_s = progress.mission_s;
  if (!first_progress_) on_first_step();
  facts_.wall_time_s = seconds_between(*first_progress_, Clock::now());
  view_.progress(progress, facts_.wall_time_s);
}

void FleetRun::hear(const status::Tally& tally) {
  facts_.points_detected = tally.points;
  facts_.score = tally.score;
  facts_.score_earned = tally.earned;
  view_.tally(tally);
}

void FleetRun::hear(const status::WaitingFor& wait) {
  view_.waiting_for(wait);
  if (first_progress_) facts_.wall_time_s = seconds_between(*first_progress_, Clock::now());
}

/// A fault takes a program out of the run, or lets it back.
void FleetRun::hear(const status::Order& order) {
  using What = status::Order::What;
  const std::string program = program_of(order.member);
  const std::string when = fmt::format("at {:.2f} s: ", order.time_s);
  if (order.order == What::kill || order.order == What::stop) {
    view_.message(when + "a fault " + name_of(order.order) + "s " + program);
    if (!in_containers_) orders_->take_out(program, order.order == What::kill, is_exec(plan_, program));
  } else {
    view_.message(when + program + (order.order == What::start ? " is started again" : " goes on"));
    if (!in_containers_) orders_->let_back(program);
  }
}

void FleetRun::hear(const status::Ended& ended) {
  note_use();
  stalled_ = !ended.stalled.empty();
  server_done_ = true;
  leave_by_.set(leave_time());
}

// ---- reactions of the launcher ----------------------------------------------------------------------------------

/// Restarts a killed program; continues a stopped one.
void FleetRun::bring_back(const std::string& program) {
  const auto spec = programs_.find(program);
  if (host_->running(program) || spec == programs_.end()) return host_->signal(program, SIGCONT);
  spec->second.append_log = true;
  debug_->on_restart(program);
  std::ofstream(spec->second.log, std::ios::app) << "[skein] a fault killed this program; here it starts again\n";
  try {
    host_->start(spec->second);
  } catch (const std::exception& error) {  // the run has a result nevertheless
    complain(program, std::string("it cannot be started again: ") + error.what());
    tell_lost(programs::member_name(program));
  }
}

/// The station or comm_router died but left its books: runs it once more, only to write its report from them.
void FleetRun::settle(const std::string& program) {
  ProgramSpec spec = programs_.at(program);
  spec.argv.push_back("--settle");
  spec.append_log = true;
  try {
    host_->start(spec);
  } catch (const std::exception& error) {
    return complain(program, std::string("cannot be started to write the report from its journal: ") + error.what());
  }
  const auto take_report = [this](const std::vector<Event>& events) {
    for (const Event& event : events) {
      if (event.kind == Event::Kind::status_line) on_status(event);
    }
  };
  const Clock::time_point deadline = Clock::now() + kLeaveTime;
  while (host_->running(program) && Clock::now() < deadline) take_report(host_->wait(kGrace));
  take_report(host_->end_all(kGrace));
}

void FleetRun::tell_lost(const std::string& member) {
  host_->send(programs::kSimServer, orders::text_of(orders::Lost{member}));
}

void FleetRun::end_stragglers() {
  for (const std::string& program : host_->running()) {
    if (!is_exec(plan_, program) && !facts_.interrupted) complain(program, "did not end after the run's end");
  }
  end_all();
}

void FleetRun::end_all() {
  if (ending_) return;
  ending_ = true;
  handle_all(host_->end_all(scaled(kGrace)));
}

/// Names the places of a program's backtrace and core after a fatal signal; empty: there are none. Also adds this to
/// the facts.
std::string FleetRun::crash_text(const std::string& program, const ExitStatus& exit) {
  const std::string where = crash_evidence(exit, programs_.at(program).log, plan_.options.cores);
  if (where.empty()) return {};
  facts_.crashes[programs::member_name(program)] = exit.text() + ", " + where;
  return ", " + where;
}

/// Names a program that failed, with the end of its log.
void FleetRun::complain(const std::string& program, const std::string& how) {
  failed_programs_.insert(program);
  const std::filesystem::path& log = programs_.at(program).log;
  facts_.warnings.push_back(results::failure_text(program, how));
  view_.message(facts_.warnings.back() + "; the end of " + log.string() + ":" + end_of_log(log, kLogLines));
}

/// The program of a member. If the launcher did not start it (a UAV under --debug): the member's name.
std::string FleetRun::program_of(const std::string& member) const {
  const std::string program = programs::program_of(member);
  return programs_.contains(program) ? program : member;
}

/// After Ctrl-C the run may not end in good order: then an exit with an error code is not a failure, but a crash is.
bool FleetRun::left_as_asked(const ExitStatus& exit) const { return facts_.interrupted && exit.signal == 0; }

/// Time for programs to leave after the run. After Ctrl-C before the first step: none, because nothing tells them that
/// the run has ended.
milliseconds FleetRun::leave_time() const {
  const milliseconds of_uavs = plan_.scenario.fleet.size() * kLeaveTimePerUav;
  if (!facts_.interrupted) return scaled(kLeaveTime + of_uavs);
  if (!first_progress_) return milliseconds(0);
  return scaled(stalled_ ? kStalledLeaveTime : kStoppedLeaveTime + of_uavs);
}

milliseconds FleetRun::scaled(milliseconds time) const {
  return std::chrono::duration_cast<milliseconds>(time * plan_.options.patience);
}

bool FleetRun::only_commands_run() const {
  const std::vector<std::string> running = host_->running();
  return std::all_of(running.begin(), running.end(), [&](const auto& program) { return is_exec(plan_, program); });
}

}  // namespace skein::cli
