#include "sim_server/sim_node.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "idl/conversions.hpp"
#include "process/thread_cpu.hpp"
#include "sim_server/referee.hpp"
#include "sim_server/scenes/scene_warnings.hpp"
#include "sim_server/wait_teller.hpp"

namespace skein::sim {
namespace {

using std::chrono::milliseconds;

// While somebody joins, matches come in without a sample to announce them.
constexpr milliseconds kMatchPoll{2};
constexpr milliseconds kIdlePoll{100};
constexpr milliseconds kProgressPeriod{200};
/// For the step that is under way when the user ends the run.
constexpr double kStopPatience_s = 2.0;

/// After so long without all answers the step is told again to who owes one, and then as often.
constexpr double kAskAgain_s = 1.0;

std::vector<std::string> names_of(const std::vector<bus::LockstepServer::Awaited>& awaited) {
  std::vector<std::string> names;
  for (const auto& one : awaited) names.push_back(one.member);
  return names;
}

std::vector<AwaitedMember> for_people(const std::vector<bus::LockstepServer::Awaited>& awaited) {
  std::vector<AwaitedMember> members;
  for (const auto& one : awaited) members.push_back({one.member, one.what});
  return members;
}

/// Who sends commands and is no member for so many steps is taken for one who does not mean to become one.
constexpr std::uint64_t kStrangerSteps = 20;

double elapsed_s(std::chrono::steady_clock::time_point since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

}  // namespace

SimNode::SimNode(const Scenario& scenario, Scene scene, const SimNodeOptions& options, bus::Bus& bus,
                 StatusPipe& status)
    : scenario_(scenario),
      options_(options),
      status_(status),
      uav_names_(scenario.uav_names()),
      simulation_(scenario, std::move(scene), options.seed, options.faults),
      fault_timeline_(options.faults),
      digest_(uav_names_),
      files_(options.out, scenario, digest_),
      inbox_(bus.run()),
      server_(inbox_) {
  participants_.push_back(bus.join(world_domain(options.base_domain)));
  for (Node node = 0; node <= scenario.fleet.size(); ++node) {
    participants_.push_back(bus.join(node_domain(options.base_domain, node)));
  }
  for (const Fault& fault : options.faults.faults) {
    const bool of_process = std::holds_alternative<Kill>(fault.action) || std::holds_alternative<Pause>(fault.action);
    if (of_process) process_faults_.push_back({fault});
  }
  declare_members();
}

SimNode::~SimNode() = default;

void SimNode::declare_members() {
  const auto world = server_.add_domain("", *participants_[0]);
  ledger_ = std::make_unique<bus::CountedWriter>(*participants_[0], bus::spec(topics::ledger()));
  const auto gcs = server_.add_domain(scenario_.node_name(kStationNode), *participants_[1]);
  gcs_boxes_ = &server_.writer(gcs, bus::spec(topics::bounding_boxes()));
  gcs_clock_ = &server_.writer(gcs, bus::spec(topics::clock()));
  gcs_remained_ = &server_.writer(gcs, bus::spec(topics::mission_duration_remained(bus::kGcsName)));
  gcs_neighbours_ = &server_.writer(gcs, bus::spec(topics::neighbour_odometry(bus::kGcsName)));
  for (std::size_t i = 0; i < scenario_.fleet.size(); ++i) {
    const auto domain = server_.add_domain(uav_names_[i], *participants_[2 + i]);
    server_.add_place(uav_names_[i], domain, true);
    uavs_.push_back(std::make_unique<UavNode>(i, scenario_, simulation_, server_, domain));
  }
  server_.on_stranger([this](auto domain, const std::string& topic, bus::ParticipantId source) {
    strangers_.add(uav_names_.at(domain - 2), topic, source, simulation_.step());
  });
  server_.add_place(std::string(bus::kGcsName), gcs, options_.expect_gcs_program);
  server_.add_place(std::string(bus::kStationName), gcs, true);
  server_.add_place(std::string(bus::kRouterName), world, true);
}

void SimNode::request_stop() {
  inbox_.post([this] {
    if (!stop_requested_) stop_requested_at_ = Clock::now();
    stop_requested_ = true;
  });
}

void SimNode::abort() {
  inbox_.post([this] { aborted_ = true; });
}

void SimNode::report_lost(const std::string& name) {
  inbox_.post([this, name] { server_.lost(name, "its process ended"); });
}

RunSummary SimNode::run() {
  files_.write_scene(simulation_.scene());
  for (std::string& warning : scene_warnings(simulation_.scene())) {
    spdlog::warn("{}", warning);
    summary_.warnings.push_back(std::move(warning));
  }
  const bool joined = wait_for_members();
  const auto started = Clock::now();
  const double cpu_before_s = thread_cpu_s();
  simulation_.watch(&clock_);
  bool answered = joined;
  while (answered) {
    last_step_ = is_last_step();
    publish_step();
    answered = wait_for_answers();
    if (!answered) break;
    finish_step();
    if (last_step_) break;
    end_process_faults();
    let_in_members();
    pace(started);
    if (aborted_) break;
    simulation_.advance();
  }
  tell_of_strangers(0);
  for (const std::string& name : uav_names_) summary_.commands_unheard.push_back(strangers_.unheard(name));
  summary_.wall_time_s = elapsed_s(started);
  summary_.timing = clock_.summary();
  summary_.timing.cpu_s = thread_cpu_s() - cpu_before_s;
  summary_.malformed = inbox_.malformed();
  summary_.unsent = participants_.front()->unsent().count();
  summary_.faults = fault_timeline_.report();
  summary_.status = end_status();
  // Where the wall clock had a say in what happened or when it ended, there is nothing to compare.
  if (options_.realtime_factor || summary_.status == RunStatus::interrupted || aborted_) summary_.deterministic = false;
  if (summary_.deterministic) summary_.digest = digest_.hex();
  files_.write_report(simulation_, summary_, status_);
  if (joined) report_progress(true);  // else there was no step to report
  status_.send_surely(status::line_json(status::Ended{summary_.status, stalled_}));
  return summary_;
}

// ---- joining ----------------------------------------------------------------------------------------------------

bool SimNode::wait_for_members() {
  WaitTeller wait(status_, "to join");
  bus::Patience patience(options_.startup_timeout_s);
  while (!server_.at_boundary()) {
    inbox_.dispatch(kMatchPoll);
    take_losses();
    if (aborted_ || stop_requested_) return false;
    wait.tell([this] { return for_people(server_.awaited()); });
    if (patience.over()) patience = give_up_awaited("did not join in time", options_.startup_timeout_s);
  }
  take_losses();
  return true;
}

/// Nobody is waited for any longer who is now. @returns the patience with whoever comes next.
bus::Patience SimNode::give_up_awaited(const std::string& why, double limit_s) {
  for (const auto& awaited : server_.awaited()) {
    server_.lost(awaited.member, fmt::format("{} (waited for: {})", why, awaited.what));
  }
  return bus::Patience(limit_s);
}

// Somebody who knocks is let in before the next step; the fleet stands still meanwhile.
void SimNode::let_in_members() {
  WaitTeller wait(status_, "to join again");
  bus::Patience patience(options_.startup_timeout_s);
  while (!server_.at_boundary() && !aborted_ && !stop_requested_) {
    inbox_.dispatch(kMatchPoll);
    wait.tell([this] { return for_people(server_.awaited()); });
    if (patience.over()) patience = give_up_awaited("did not finish joining", options_.startup_timeout_s);
  }
  for (const std::string& name : server_.take_rejoined()) {
    spdlog::info("{} joined again at step {}", name, simulation_.step() + 1);
    status_.send_surely(status::line_json(status::Rejoined{name}));
    const auto uav = std::find(uav_names_.begin(), uav_names_.end(), name);
    if (uav != uav_names_.end()) uavs_[static_cast<std::size_t>(uav - uav_names_.begin())]->resend_captures();
  }
  take_losses();
}

// At the boundary before step k + 1. The order to carry on comes from the launcher: the program cannot hear us.
void SimNode::end_process_faults() {
  const Tick next_tick = simulation_.tick() + scenario_.exchange_ticks();
  for (ProcessFault& fault : process_faults_) {
    if (!fault.acting || fault.fault.active(next_tick)) continue;
    fault.acting = false;
    const std::string member = fault_target(fault.fault);
    if (server_.let_back(member)) tell_order(member, fault.kill() ? What::start : What::resume, next_tick);
  }
}

// Before step k is published, which then tells the victims what to do.
void SimNode::begin_process_faults() {
  const Tick tick = simulation_.tick();
  for (ProcessFault& fault : process_faults_) {
    if (fault.acting || !fault.fault.active(tick)) continue;
    fault.acting = true;
    const std::string member = fault_target(fault.fault);
    if (server_.take_out(member, fault.kill() ? bus::kOrderKill : bus::kOrderStop)) {
      tell_order(member, fault.kill() ? What::kill : What::stop, tick);
    } else {
      summary_.warnings.push_back(fault_kind(fault.fault) + " " + member + ": it took no part in the run then");
    }
  }
}

void SimNode::tell_order(const std::string& member, What order, Tick tick) {
  status_.send_surely(status::line_json(status::Order{member, order, seconds(tick)}));
}

void SimNode::take_losses() {
  for (const auto& lost : server_.take_lost()) {
    spdlog::warn("{} is lost at step {}: {}; the run goes on without it", lost.name, lost.k, lost.reason);
    summary_.lost.push_back({lost.name, lost.k, simulation_.tick(), lost.reason});
    summary_.warnings.push_back(lost.name + " was lost: " + lost.reason);
    summary_.deterministic = false;
  }
}

// Commands from outside the lock-step have no effect. Their sender sees a matched subscriber, and must not wonder.
void SimNode::tell_of_strangers(std::uint64_t patience) {
  const auto is_stranger = [this](bus::ParticipantId source) { return server_.is_stranger(source); };
  for (const bus::Strangers::Notice& notice : strangers_.take_notices(simulation_.step(), patience, is_stranger)) {
    const std::string text = describe(notice);
    spdlog::warn("{}", text);
    status_.send_surely(status::line_json(status::Warning{text}));
    summary_.warnings.push_back(text);
    const auto uav = std::find(uav_names_.begin(), uav_names_.end(), notice.node);
    uavs_[static_cast<std::size_t>(uav - uav_names_.begin())]->reject_unheard(notice.topic);
  }
}

// ---- one step ---------------------------------------------------------------------------------------------------

bool SimNode::is_last_step() const {
  const bool stop_time = options_.stop_at_s && simulation_.tick() >= ticks(*options_.stop_at_s);
  return stop_requested_ || stop_time || simulation_.mission().phase() == Phase::ended;
}

void SimNode::publish_step() {
  for (const std::string& line : fault_timeline_.enter_step(simulation_.step(), simulation_.tick())) {
    spdlog::info("{}", line);
  }
  begin_process_faults();
  tell_of_strangers(kStrangerSteps);
  server_.hold();
  const StepEvents& events = simulation_.events();
  publish_ledger(simulation_.referee().ledger(), events.ledger_begin);
  for (const Collision& collision : events.collisions) {
    spdlog::warn("{}", describe(collision, scenario_));
    summary_.collisions.push_back(collision);
  }
  for (const Stray& stray : events.strays) {
    summary_.warnings.push_back(describe(stray, scenario_));
    spdlog::warn("{}", summary_.warnings.back());
  }
  for (const auto& uav : uavs_) uav->publish();

  const Tick tick = simulation_.tick();
  if (gcs_boxes_->count() == 0) gcs_boxes_->write(to_box_vertices(tick, simulation_.scene().boxes));
  msg::Clock clock;
  clock.clock(to_time(tick));
  gcs_clock_->write(clock);
  if (simulation_.mission().start_tick()) gcs_remained_->write(to_duration(simulation_.mission().remaining_s(tick)));
  gcs_neighbours_->write(neighbour_cloud(simulation_, scenario_, kStationNode));

  server_.publish({.k = simulation_.step(),
                   .tick = tick,
                   .links = simulation_.links(),
                   .ledger_upto = events.ledger_end,
                   .final_step = last_step_});
}

// The first message is sent even when nothing is written down: it tells the station which points there are.
void SimNode::publish_ledger(const std::vector<LedgerEntry>& entries, std::size_t begin) {
  if (begin == entries.size() && ledger_->count() > 0) return;
  auto message = bus::message_of<msg::Ledger>(inbox_.run());
  const std::vector<InterestPoint>& points = simulation_.scene().points;
  message.interest_points(static_cast<std::uint32_t>(points.size()));
  if (ledger_->count() == 0) {
    for (const InterestPoint& point : points) message.points().push_back(to_message(point));
  }
  for (std::size_t i = begin; i < entries.size(); ++i) message.entries().push_back(to_message(entries[i], uav_names_));
  ledger_->begin_step();
  ledger_->write(message);
}

bool SimNode::wait_for_answers() {
  WaitTeller wait(status_, "to answer");
  bus::Patience patience(options_.agent_timeout_s), until_asked_again(kAskAgain_s);
  while (!server_.answered()) {
    const bool arrived = inbox_.dispatch(kIdlePoll, server_.rings());
    const bool told = wait.tell([this] { return for_people(server_.awaited()); });
    if (!arrived && !told) report_progress(false);
    if (aborted_ || gives_up_step()) return false;
    if (patience.over()) {
      patience =
          give_up_awaited(fmt::format("did not answer for {} s", options_.agent_timeout_s), options_.agent_timeout_s);
    }
    if (until_asked_again.over()) {
      server_.ask_again();
      until_asked_again = bus::Patience(kAskAgain_s);
    }
  }
  for (const std::string& doubt : server_.take_doubts()) {
    spdlog::warn("{}; the run is not repeatable", doubt);
    summary_.warnings.push_back("decided by a wall clock: " + doubt);
    summary_.deterministic = false;
  }
  take_losses();
  return true;
}

// The user ends the run, and somebody does not answer: a hung planner, an agent in a debugger that has gone.
bool SimNode::gives_up_step() {
  if (!stop_requested_ || elapsed_s(stop_requested_at_) < kStopPatience_s) return false;
  stalled_ = names_of(server_.awaited());
  std::string text = fmt::format("interrupted in step {}, which was not finished; it waited for", simulation_.step());
  for (const std::string& name : stalled_) text += " " + name;
  spdlog::warn("{}", text);
  summary_.warnings.push_back(std::move(text));
  return true;
}

void SimNode::finish_step() {
  const WorkSection section(&clock_, Work::recording);
  DigestInput input = simulation_.digest_input();
  input.radio = server_.routed_digest();
  input.tally = server_.station_digest();
  files_.add_step(simulation_, digest_.add(input));
  files_.events().add_step(simulation_, [this](const std::string& member) { return server_.is_member(member); });
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    for (const std::uint64_t capture : uavs_[i]->take_released()) {
      files_.events().add_release(simulation_, uav_names_[i], capture);
    }
  }
  report_progress(false);
}

// Real time: the next step is due when the wall clock says so; what arrives meanwhile is taken in.
void SimNode::pace(Clock::time_point started) {
  if (!options_.realtime_factor) return;
  const double due_s = seconds(simulation_.tick() + scenario_.exchange_ticks()) / *options_.realtime_factor;
  const auto due = started + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s));
  while (Clock::now() < due && !aborted_ && !stop_requested_) {
    inbox_.dispatch(std::min(std::chrono::ceil<milliseconds>(due - Clock::now()), kProgressPeriod));
    report_progress(false);
  }
}

void SimNode::report_progress(bool now) {
  const Mission& mission = simulation_.mission();
  if (!now && mission.phase() == last_phase_ && Clock::now() - last_progress_ < kProgressPeriod) return;
  last_progress_ = Clock::now();
  last_phase_ = mission.phase();
  const auto& links = simulation_.open_links();
  status::Progress progress{.time_s = seconds(simulation_.tick()),
                            .mission_s = 0.0,
                            .duration_s = scenario_.duration_s,
                            .phase = mission.phase()};
  if (mission.start_tick()) progress.mission_s = seconds(simulation_.tick() - *mission.start_tick());
  for (std::size_t i = 0; i < simulation_.size(); ++i) {
    if (links[node_of_uav(i)]) progress.in_contact.push_back(uav_names_[i]);
    progress.alive += simulation_.uav(i).alive;
  }
  for (const LostProcess& process : summary_.lost) progress.lost.push_back(process.name);
  status_.send(status::line_json(progress));
}

RunStatus SimNode::end_status() const {
  if (aborted_) return RunStatus::aborted;
  if (stop_requested_) return RunStatus::interrupted;
  if (simulation_.mission().end() == MissionEnd::takeoff_timeout) return RunStatus::no_takeoff;
  return RunStatus::completed;
}

}  // namespace skein::sim
