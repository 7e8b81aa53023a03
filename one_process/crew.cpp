#include "one_process/crew.hpp"

#include <spdlog/spdlog.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <system_error>
#include <utility>

#include "bus/lockstep/self_signal.hpp"
#include "one_process/death_notice.hpp"
#include "one_process/program_output.hpp"
#include "process/host/thread_cpu.hpp"
#include "results/run_folder.hpp"

namespace skein::one_process {
namespace {

// Thrown when a fault kills or stops a program in the middle of its turn. They are not derived from std::exception, so
// that only outcome_of() catches them.
struct Killed {};
struct Paused {};

std::vector<const char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  return pointers;
}

}  // namespace

struct Crew::Place {
  Place(const shared_lines::Start& order, StatusPipe& pipe)
      : name(order.program),
        counts_cpu(order.program == programs::kSimServer),
        output(order.log, order.append_log),
        notice(order.program, output.descriptor()),
        status(pipe, order.program) {}

  const std::string name;
  const bool counts_cpu;  ///< across turns; only for the server, since reading the clock takes time
  ProgramOutput output;
  const DeathNotice notice;
  StatusPipe status;
  std::unique_ptr<bus::FleetProgram> program;
  std::unique_ptr<bus::FleetMember> member;
  bool started = false;    ///< whether its present node was started
  bool paused = false;     ///< by a fault
  bool continued = false;  ///< the pause is over: the program is due a turn
  bool stopped = false;    ///< the program was asked to end
  bool over = false;
  double cpu_s = 0.0;
};

/// While it exists, this thread works for the program; in a turn alone, so does the whole process.
struct Crew::Turn {
  Turn(Crew& crew, Place& place, bool is_beside)
      : crew_(crew), place_(place), beside(is_beside), number(static_cast<std::size_t>(Workers::here())) {
    beside ? place.output.enter_beside() : place.output.enter();
    place.notice.enter();
    if (place.counts_cpu) begin_thread_cpu_share(place.cpu_s);
    crew.seats_[number].holder = &place.notice;
    ++crew.seats_[number].turns;
    if (crew.page_ != nullptr) crew.page_->enter(number, place.name);
  }
  ~Turn() {
    ++crew_.seats_[number].turns;
    crew_.seats_[number].holder = nullptr;
    if (crew_.page_ != nullptr) crew_.page_->leave(number);
    if (place_.counts_cpu) place_.cpu_s = thread_cpu_s();
    DeathNotice::stand_down();
    if (beside) ProgramOutput::leave_beside();
  }

  Crew& crew_;
  Place& place_;
  const bool beside;
  const std::size_t number;  ///< the seat
};

Crew::Crew(StatusPipe& pipe, MakeProgram make_program, TurnPage* page, int status_fd, Workers* workers)
    : pipe_(pipe), make_program_(std::move(make_program)), page_(page), status_fd_(status_fd), workers_(workers) {
  struct stat status {};
  if (status_fd_ >= 0 && ::fstat(status_fd_, &status) == 0) pipe_inode_ = status.st_ino;
  bus::set_self_signals({.kill = [] { throw Killed{}; }, .stop = [] { throw Paused{}; }});
}

Crew::~Crew() { bus::set_self_signals({}); }

void Crew::obey(const shared_lines::Order& order) {
  if (const auto* begins = std::get_if<shared_lines::Start>(&order)) return start(*begins);
  if (const auto* told = std::get_if<shared_lines::Tell>(&order)) {
    if (Place* place = find(told->program); place != nullptr && place->member) place->member->obey(told->line);
  }
  if (const auto* sent = std::get_if<shared_lines::Signal>(&order)) {
    if (Place* place = find(sent->program)) signal(*place, sent->signal);
  }
}

void Crew::start(const shared_lines::Start& order) try {
  places_.push_back(std::make_unique<Place>(order, pipe_));
  Place& place = *places_.back();
  in_turn(place, [&]() -> std::optional<int> {
    place.program = make_program_(place.name);
    const auto argv = pointers_to(order.argv);
    const auto options = parse_program(place.program->name(), static_cast<int>(argv.size()), argv.data(),
                                       [&](CLI::App& app) { place.program->add_options(app); });
    if (const int* code = std::get_if<int>(&options)) return *code;
    const auto& parsed = std::get<ProgramOptions>(options);
    place.output.set_log(order.log.empty() ? place.name : place.program->name(), parsed.log_level);
    auto prepared = place.program->prepare(parsed, place.status);
    if (const int* code = std::get_if<int>(&prepared)) return *code;
    place.member = std::move(std::get<std::unique_ptr<bus::FleetMember>>(prepared));
    return std::nullopt;
  });
} catch (const std::system_error& error) {  // the log cannot be opened: a process of its own would not have started
  spdlog::error("{} cannot be started: {}", order.program, error.what());
  pipe_.send_surely(shared_lines::news_json(shared_lines::Ended{order.program, kExitProcessFailed, 0, false}));
}

bool Crew::round() {
  bool any = false;
  std::vector<Place*> beside;
  for (std::size_t i = 0; i < places_.size(); ++i) {  // programs that are added meanwhile are at the end
    Place& place = *places_[i];
    if (place.over || place.paused) continue;
    const bool flies_beside = seats() > 1 && place.member->flies_beside();
    if (!flies_beside) turns_beside(beside);  // this one may wait for what they send
    if (!is_due(place, any)) continue;
    if (flies_beside) {
      beside.push_back(&place);
    } else {
      in_turn(place, [&] { return go_on(place); });
    }
  }
  turns_beside(beside);
  std::erase_if(places_, [](const auto& place) { return place->over; });
  return any;
}

bool Crew::is_due(Place& place, bool& any) const {
  bus::LockstepNode& node = place.member->node();
  const bus::LockstepNode::Rest rest = node.rest();
  const bool ready = node.inbox().ready(rest.rings);
  const bool news = !place.started || place.continued || place.stopped;
  if (!news && rest.until_rung && !ready) return false;
  any = any || ready || news;
  return true;
}

void Crew::turns_beside(std::vector<Place*>& places) {
  if (places.size() == 1) in_turn(*places[0], [&] { return go_on(*places[0]); });
  if (places.size() > 1) {
    ProgramOutput::stand_aside();
    std::vector<Outcome> outcomes(places.size());
    workers_->run(places.size(), [&](std::size_t i) {
      outcomes[i] = outcome_of(*places[i], true, [&] { return go_on(*places[i]); });
    });
    for (std::size_t i = 0; i < places.size(); ++i) settle(*places[i], outcomes[i]);
  }
  places.clear();
}

std::optional<int> Crew::go_on(Place& place) {
  bus::FleetMember& member = *place.member;
  if (std::exchange(place.stopped, false)) {
    if (member.stops_at_once()) return member.ended(bus::NodeEnd::stopped);
    member.on_stop();
  }
  bus::LockstepNode& node = member.node();
  if (!std::exchange(place.started, true)) node.start();
  if (!node.end()) {
    place.continued = false;
    node.turn(node.inbox().dispatch(std::chrono::milliseconds(0)));
  }
  if (!node.end()) return std::nullopt;
  const std::optional<int> code = member.ended(*node.end());
  place.started = code.has_value();
  return code;
}

void Crew::in_turn(Place& place, const std::function<std::optional<int>()>& work) {
  settle(place, outcome_of(place, false, work));
}

Crew::Outcome Crew::outcome_of(Place& place, bool beside, const std::function<std::optional<int>()>& work) {
  Outcome outcome;
  const Turn turn(*this, place, beside);
  try {
    const int went = guarded(place.program ? place.program->name() : place.name, [&] {
      outcome.code = work();
      return kExitDone;
    });
    if (went != kExitDone) outcome.code = went;
  } catch (const Killed&) {
    outcome.killed = true;
  } catch (const Paused&) {
    if (place.member) {
      place.paused = true;
      place.member->node().inbox().set_deaf(true);
      pipe_.send_surely(shared_lines::news_json(shared_lines::Stopped{place.name}));
    } else {  // its start was cut off: there is nothing that could go on later
      std::cerr << place.name << ": failed: it was stopped before it was ready" << std::endl;
      outcome.code = kExitProcessFailed;
    }
  } catch (...) {  // an unknown exception: a process of its own would have aborted
    std::cerr << place.name << ": failed: an exception that is not a std::exception" << std::endl;
    outcome.signal = SIGABRT;
    outcome.code = kExitProcessFailed;
  }
  if (outcome.code) place.member.reset();  // leaves the bus properly
  check_pipe(place, beside);
  return outcome;
}

void Crew::settle(Place& place, const Outcome& outcome) {
  if (outcome.killed) return kill(place);
  if (outcome.code) end(place, outcome.signal == 0 ? *outcome.code : 0, outcome.signal);
}

void Crew::check_pipe(const Place& place, bool beside) const {
  struct stat status {};
  if (status_fd_ < 0 || (::fstat(status_fd_, &status) == 0 && status.st_ino == pipe_inode_)) return;
  const std::string reason = "closed file descriptors that are not its own, which ends the whole fleet here";
  if (!beside) std::cerr << place.name << ": " << reason << std::endl;
  if (page_ != nullptr) page_->give_reason("this program " + reason);  // or one that has its turn in parallel
  ::_exit(kExitProcessFailed);
}

void Crew::end(Place& place, int code, int signal) {
  place.over = true;
  const shared_lines::Ended ended{place.name, code, signal, false};
  if (!failure_ && (code != kExitDone || signal != 0)) failure_ = ended;
  pipe_.send_surely(shared_lines::news_json(ended));
}

// The killed program is not destroyed, because no destructor of the program or its planner may send or write anything.
// It is kept in a global list, so that leak checkers see it as reachable.
void Crew::kill(Place& place) {
  static auto& graveyard =
      *new std::vector<std::pair<std::unique_ptr<bus::FleetProgram>, std::unique_ptr<bus::FleetMember>>>;
  if (place.member) {
    place.member->vanish();
    place.member->node().inbox().set_deaf(true);
  }
  graveyard.emplace_back(std::move(place.program), std::move(place.member));
  end(place, 0, SIGKILL);
}

void Crew::signal(Place& place, int signal) {
  if (place.over) return;
  if (signal == SIGKILL) return kill(place);
  if (signal == SIGTERM) place.stopped = true;
  if (!place.paused) return;
  place.paused = false;
  place.continued = true;
  place.member->node().inbox().set_deaf(false);
}

void Crew::ring(const std::string& program) {
  if (Place* place = find(program); place != nullptr && place->member) place->member->node().inbox().wake();
}

void Crew::stop() {
  for (const auto& place : places_) signal(*place, SIGTERM);
}

Crew::Place* Crew::find(const std::string& program) {
  const auto found = std::find_if(places_.begin(), places_.end(),
                                  [&](const auto& place) { return place->name == program && !place->over; });
  return found == places_.end() ? nullptr : found->get();
}

}  // namespace skein::one_process
