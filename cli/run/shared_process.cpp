#include "cli/run/shared_process.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "process/shared_lines.hpp"

namespace skein::cli {

void SharedProcess::start(const ProgramSpec& spec) {
  if (!supervisor_.running(process_.name)) {
    supervisor_.start(process_);
    process_.append_log = true;
    explained_ = false;
  }
  running_.insert(spec.name);
  supervisor_.send(process_.name,
                   shared_lines::text_of(shared_lines::Start{spec.name, spec.argv, spec.log, spec.append_log}));
}

std::vector<Event> SharedProcess::wait(std::chrono::milliseconds limit) { return translated(supervisor_.wait(limit)); }

void SharedProcess::send(const std::string& program, const std::string& line) {
  if (running(program)) supervisor_.send(process_.name, shared_lines::text_of(shared_lines::Tell{program, line}));
}

void SharedProcess::signal(const std::string& program, int signal) {
  if (running(program)) supervisor_.send(process_.name, shared_lines::text_of(shared_lines::Signal{program, signal}));
}

std::vector<Event> SharedProcess::end_all(std::chrono::milliseconds grace) {
  using Clock = std::chrono::steady_clock;
  std::vector<Event> all;
  const auto add = [&all](std::vector<Event> events) { std::ranges::move(events, std::back_inserter(all)); };
  supervisor_.hang_up(process_.name);
  // Without programs it ends by itself.
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

/// All that still ran has ended with the process.
void SharedProcess::on_death(const Event& event, std::vector<Event>& events) {
  events.push_back(event);
  events.back().exit.dragged = explained_;
  ExitStatus with_it = event.exit;
  if (with_it.ok()) with_it.code = 1;
  with_it.shared = with_it.dragged = true;
  for (const std::string& program : std::exchange(running_, {})) {
    events.push_back({Event::Kind::exited, program, {}, with_it});
  }
}

}  // namespace skein::cli
