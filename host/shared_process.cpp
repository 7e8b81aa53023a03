#include "host/shared_process.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <utility>
#include <variant>

#include "host/proc_table.hpp"
#include "process/status/shared_lines.hpp"

namespace skein::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Interval at which the launcher checks the turns.
constexpr std::chrono::milliseconds kLook{200};
/// Factor on the patience. The process watches its turns, too, and can say more about them, so it must notice a long
/// turn first.
constexpr double kTimesPatience = 1.5;

}  // namespace

SharedProcess::SharedProcess(ProgramSpec process, double patience_s)
    : process_(std::move(process)), patience_(patience_s) {
  process_.argv.insert(process_.argv.end(), {"--turn-page", page_.path()});
}

void SharedProcess::start(const ProgramSpec& spec) {
  if (!supervisor_.running(process_.name)) {
    page_.clear();
    supervisor_.start(process_);
    process_.append_log = true;
    explained_ = false;
  }
  running_.insert(spec.name);
  logs_[spec.name] = spec.log;
  supervisor_.limit_log(spec.log, spec.most_log_bytes);
  supervisor_.send(process_.name,
                   shared_lines::text_of(shared_lines::Start{spec.name, spec.argv, spec.log, spec.append_log}));
}

std::vector<Event> SharedProcess::wait(std::chrono::milliseconds limit) {
  look_after_turns();
  const bool timed = patience_.count() > 0.0 && (limit.count() < 0 || limit > kLook);
  return translated(supervisor_.wait(timed ? kLook : limit));
}

void SharedProcess::look_after_turns() {
  if (patience_.count() <= 0.0) return;
  const Clock::time_point now = Clock::now();
  bool too_long = false;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    Seat& seat = seats_[i];
    const std::uint64_t turn = page_.turns(i);
    if (turn != std::exchange(seat.turn, turn) || turn % 2 == 0) seat.since = now;
    too_long = too_long || now - seat.since >= kTimesPatience * patience_;
  }
  if (!too_long) return;
  for (Seat& seat : seats_) seat.since = now;
  if (tracer_of(page_.process()) != 0) return;  // a program in a debugger may take any time
  page_.give_reason(fmt::format("this program did not end its turn for {} s, and its process {}", patience_.count(),
                                cli::has_stopped(page_.process()) ? "is stopped (SIGSTOP)" : "does not say why"));
  supervisor_.signal(process_.name, SIGKILL);
}

void SharedProcess::send(const std::string& program, const std::string& line) {
  if (running(program)) supervisor_.send(process_.name, shared_lines::text_of(shared_lines::Tell{program, line}));
}

void SharedProcess::signal(const std::string& program, int signal) {
  if (running(program)) supervisor_.send(process_.name, shared_lines::text_of(shared_lines::Signal{program, signal}));
}

std::vector<Event> SharedProcess::end_all(std::chrono::milliseconds grace) {
  std::vector<Event> all;
  const auto add = [&all](std::vector<Event> events) { std::ranges::move(events, std::back_inserter(all)); };
  supervisor_.hang_up(process_.name);
  // Without programs the process ends by itself.
  for (const auto deadline = Clock::now() + grace; running_.empty() && supervisor_.running(process_.name);) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) break;
    add(wait(left));
  }
  add(translated(supervisor_.end_all(grace)));
  return all;
}

std::vector<Event> SharedProcess::translated(const std::vector<Event>& events) {
  std::vector<Event> all;
  for (const Event& event : events) {
    if (event.kind == Event::Kind::status_line) {
      hear(event.line, all);
    } else if (event.kind == Event::Kind::exited) {
      on_death(event, all);
    } else {
      all.push_back(event);
    }
  }
  return all;
}

void SharedProcess::hear(const std::string& text, std::vector<Event>& events) {
  const auto news = shared_lines::read_news(text);
  if (!news) return;
  if (const auto* said = std::get_if<shared_lines::Said>(&*news)) {
    if (running(said->program)) events.push_back({Event::Kind::status_line, said->program, said->line.dump(), {}});
  } else if (const auto* ended = std::get_if<shared_lines::Ended>(&*news)) {
    if (running_.erase(ended->program) == 0) return;
    const ExitStatus exit{.code = ended->code, .signal = ended->signal, .shared = true};
    explained_ = explained_ || ended->fatal;
    events.push_back({Event::Kind::exited, ended->program, {}, exit});
  } else {
    stopped_.insert(std::get<shared_lines::Stopped>(*news).program);
  }
}

std::string SharedProcess::blame(const ExitStatus& exit) {
  std::vector<std::string> holders = page_.holders();
  std::erase_if(holders, [this](const std::string& holder) { return !running(holder); });
  if (holders.empty()) return {};
  std::string reason = page_.reason();
  // These signals come from outside: from a user, a system out of memory, or the launcher at the end of a run.
  if (reason.empty() && (exit.signal == SIGKILL || exit.signal == SIGTERM || exit.signal == SIGINT)) return {};
  if (reason.empty()) {
    reason = exit.signal != 0 ? "the process ended in this program's turn: " + exit.text()
                              : "the process ended in this program's turn with " + exit.text() +
                                    ": the program called _exit() or quick_exit(), or became another one (exec)";
  }
  if (holders.size() > 1) {
    std::ofstream(process_.log, std::ios::app) << fmt::format(
        "[skein] {}; 'this program' is one of {}, which had their turns side by side: --threads 1 tells which\n",
        reason, fmt::join(holders, ", "));
    return {};
  }
  std::ofstream(logs_[holders.front()], std::ios::app) << "[skein] " << reason << '\n';
  return holders.front();
}

/// All programs that still ran have ended with the process.
void SharedProcess::on_death(const Event& event, std::vector<Event>& events) {
  const std::string guilty = explained_ ? std::string() : blame(event.exit);
  ExitStatus with_it = event.exit;
  if (with_it.ok() && !running_.empty()) with_it.code = 1;
  events.push_back(event);
  events.back().exit.code = with_it.code;
  events.back().exit.dragged = explained_ || !guilty.empty();
  with_it.shared = true;
  if (!guilty.empty()) {
    running_.erase(guilty);
    events.push_back({Event::Kind::exited, guilty, {}, with_it});
  }
  with_it.dragged = true;
  for (const std::string& program : std::exchange(running_, {})) {
    events.push_back({Event::Kind::exited, program, {}, with_it});
  }
}

}  // namespace skein::cli
