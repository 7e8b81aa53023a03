#include "sim_server/sim_node.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "process/host/thread_cpu.hpp"
#include "scenes/scene_warnings.hpp"
#include "sim_server/referee.hpp"

namespace skein::sim {
namespace {

using std::chrono::milliseconds;

// Longest times between two turns: kMatchPoll while programs join, because no sample tells the server that DDS has
// matched two endpoints; kIdlePoll while the server waits for answers.
constexpr milliseconds kMatchPoll{2}, kIdlePoll{100};
// Indices of the domains that the server joins. The UAVs' domains follow in fleet order.
constexpr std::size_t kWorldDomain = 0, kGcsDomain = 1, kFirstUavDomain = 2;
/// How long the server still waits for the answers to the current step after the user has asked it to end the run.
constexpr double kStopPatience_s = 2.0;
/// While members owe an answer, the server repeats the step in their domains, at this interval.
constexpr double kAskAgain_s = 1.0;

std::vector<AwaitedMember> for_people(const std::vector<bus::LockstepServer::Awaited>& awaited) {
  std::vector<AwaitedMember> members;
  for (const auto& one : awaited) members.push_back({one.member, one.what});
  return members;
}

/// A participant that is not a member and sends commands has this many steps, from its first command on, to ask to
/// join. Then the server warns the user that these commands have no effect.
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
      digest_(uav_names_),
      files_(options.out, scenario, digest_, options.flight),
      recording_(options.out, options.record, scenario, files_.events(), options.replay),
      inbox_(bus.run()),
      server_(inbox_, recording_.tap()),
      hand_(scenario, simulation_, options.by_hand, options.out),
      faults_(scenario, simulation_, server_, status, options_.replay, options.out),
      progress_(scenario, status) {
  simulation_.share_work(options.for_each);
  if (!options.gate) work_.emplace(scenario, simulation_);
  participants_.push_back(bus.join(world_domain(options.base_domain)));
  for (const Node node : scenario.nodes()) {
    participants_.push_back(bus.join(node_domain(options.base_domain, node)));
  }
  declare_members();
}

SimNode::~SimNode() = default;

void SimNode::declare_members() {
  const auto world = server_.add_domain("", *participants_[0]);
  const auto gcs = server_.add_domain(scenario_.node_name(kStationNode), *participants_[1]);
  gcs_ = std::make_unique<GcsNode>(scenario_, simulation_, server_, gcs, *participants_[0]);
  viz_ = std::make_unique<VizNode>(scenario_, simulation_, *participants_[0]);
  if (const auto& watch = options_.watch) {
    watch_ = std::make_unique<WatchNode>(scenario_, simulation_, files_.events(), inbox_, *participants_[0],
                                         std::span(participants_).subspan(2), *watch, faults_, hand_);
  }
  for (const UavIndex i : FirstUavs(scenario_.fleet.size())) {
    const auto domain = server_.add_domain(uav_names_[i], *participants_[2 + i]);
    server_.add_place(uav_names_[i], domain, options_.replay.takes_part(uav_names_[i]));
    uavs_.push_back(std::make_unique<UavNode>(i, scenario_, simulation_, heard_, server_, domain));
    frames_.push_back(std::make_unique<FramesNode>(scenario_.fleet[i], i, simulation_, *participants_[2 + i]));
    hand_.declare(i, server_, domain);
  }
  server_.on_stranger([this](auto domain, const std::string& topic, bus::ParticipantId source) {
    const std::string& uav = uav_names_.at(domain - kFirstUavDomain);
    if (!has_stand_in(uav)) strangers_.add(uav, topic, source, simulation_.step());
  });
  server_.on_hello([this](auto domain, const std::vector<std::string>& writes) {
    if (domain >= kFirstUavDomain) uavs_.at(domain - kFirstUavDomain)->read_debug(writes);
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

void SimNode::start() {
  files_.write_scene(simulation_.scene());
  for (std::string& warning : scene_warnings(simulation_.scene())) {
    spdlog::warn("{}", warning);
    summary_.warnings.push_back(std::move(warning));
  }
  wait_for(State::joining, "to join", options_.startup_timeout_s);
}

void SimNode::turn(bool arrived) {
  // While all members are alive, samples arrive often: it suffices to look for dead members when none have arrived.
  if (options_.notice_deaths && !arrived) server_.drop_vanished();
  const auto go_on = [&] {
    switch (state_) {
      case State::joining:
        return join_members();
      case State::in_step:
        return take_answers(std::exchange(arrived, true));
      case State::letting_in:
        return let_in_members();
      case State::pacing:
        return keep_pace();
      case State::over:
        return false;
    }
    return false;
  };
  while (go_on()) {
  }
}

std::optional<bus::NodeEnd> SimNode::end() const {
  return state_ == State::over ? std::optional(bus::NodeEnd::finished) : std::nullopt;
}

bus::LockstepNode::Rest SimNode::rest() {
  if (state_ == State::in_step) return {.longest = kIdlePoll, .rings = server_.rings(), .until_rung = true};
  if (state_ != State::pacing) return {.longest = kMatchPoll, .until_rung = false};
  const auto left =
      options_.realtime_factor || !watch_ ? std::chrono::ceil<milliseconds>(due() - Clock::now()) : watch_->left();
  return {.longest = std::clamp(left, milliseconds(0), ProgressTeller::kPeriod), .until_rung = false};
}

void SimNode::wait_for(State state, const char* what, double patience_s) {
  state_ = state;
  wait_.emplace(status_, what);
  patience_s_ = patience_s;
  patience_ = bus::Patience(patience_s);
  until_asked_again_ = bus::Patience(kAskAgain_s);
}

bool SimNode::tell_waiting() {
  return wait_->tell([this] {
    std::vector<AwaitedMember> awaited = for_people(server_.awaited());
    if (watch_) watch_->wait_for(awaited, wait_->what());
    return awaited;
  });
}

/// Declares all programs lost for which the server waits now, and restarts the timeout for those that are awaited next.
void SimNode::give_up_awaited(const std::string& why) {
  for (const auto& awaited : server_.awaited()) {
    server_.lost(awaited.member, fmt::format("{} (waited for: {})", why, awaited.what));
  }
  patience_ = bus::Patience(patience_s_);
}

// ---- from the first member to the last step ---------------------------------------------------------------------

bool SimNode::join_members() {
  take_losses();
  if (aborted_ || stop_requested_) return end_run(false);
  if (!server_.at_boundary()) {
    tell_waiting();
    if (patience_.over()) give_up_awaited("did not join in time");
    return false;
  }
  take_losses();
  take_returns(simulation_.step());
  started_ = Clock::now();
  cpu_before_s_ = thread_cpu_s();
  simulation_.watch(&clock_);
  begin_step();
  return true;
}

void SimNode::begin_step() {
  last_step_ = is_last_step();
  publish_step();
  if (options_.gate) options_.gate->begin(simulation_, digest_, last_step_);
  wait_for(State::in_step, "to answer", options_.agent_timeout_s);
}

bool SimNode::take_answers(bool arrived) {
  if (options_.gate && !options_.gate->may_end(simulation_.step())) return false;
  if (!server_.answered()) {
    const bool told = tell_waiting();
    if (!arrived && !told) progress_.tell(simulation_, summary_.lost);
    if (aborted_ || gives_up_step()) {
      end_run(true);
      return false;
    }
    if (patience_.over()) give_up_awaited(fmt::format("did not answer for {} s", options_.agent_timeout_s));
    if (!options_.gate && until_asked_again_.over()) {
      server_.ask_again();
      until_asked_again_ = bus::Patience(kAskAgain_s);
    }
    return false;
  }
  for (const std::string& doubt : server_.take_doubts()) {
    spdlog::warn("{}; the run is not repeatable", doubt);
    summary_.warnings.push_back("decided by a wall clock: " + doubt);
    summary_.deterministic = false;
  }
  take_losses();
  recording_.end_step();
  finish_step();
  if (last_step_) {
    end_run(true);
    return false;
  }
  return let_back();
}

bool SimNode::let_back() {
  faults_.let_back_victims();
  wait_for(State::letting_in, "to join again", options_.startup_timeout_s);
  return true;
}

// Lets programs that ask to join become members before the next step begins. Until then the fleet waits.
bool SimNode::let_in_members() {
  if (!server_.at_boundary() && !aborted_ && !stop_requested_) {
    tell_waiting();
    if (patience_.over()) give_up_awaited("did not finish joining");
    return false;
  }
  take_losses();
  take_returns(simulation_.step() + 1);
  state_ = State::pacing;
  return true;
}

// Begins the next step when it is due: at a time of the wall clock (--clock realtime), when the viewer's page lets the
// run continue, else at once. Until then the server still receives samples.
bool SimNode::keep_pace() {
  if (watch_ && watch_->obey_fault_orders()) return let_back();
  const bool held = (options_.realtime_factor && Clock::now() < due()) || (watch_ && !watch_->may_go_on());
  if (held && !aborted_ && !stop_requested_) {
    progress_.tell(simulation_, summary_.lost);
    return false;
  }
  if (aborted_) return end_run(true);
  for (const UavIndex i : FirstUavs(uavs_.size())) uavs_[i]->choose_scans(watch_ && watch_->wants_scan(i));
  simulation_.advance();
  begin_step();
  return true;
}

SimNode::Clock::time_point SimNode::due() const {
  if (!options_.realtime_factor) return started_;
  const double due_s = seconds(simulation_.tick() + scenario_.exchange_ticks()) / *options_.realtime_factor;
  return started_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s));
}

// ---- one step ---------------------------------------------------------------------------------------------------

bool SimNode::is_last_step() const {
  const bool stop_time = options_.stop_at_s && simulation_.tick() >= ticks(*options_.stop_at_s);
  return stop_requested_ || stop_time || recording_.is_replayed(simulation_.tick()) ||
         simulation_.mission().phase() == Phase::ended;
}

void SimNode::publish_step() {
  const std::vector<std::string> faults = faults_.begin_step();
  recording_.begin_step(simulation_, faults);
  hand_.begin_step();
  if (watch_) watch_->begin_step(faults);
  faults_.take_out_victims();
  for (std::string& warning : faults_.take_warnings()) summary_.warnings.push_back(std::move(warning));
  tell_of_strangers(kStrangerSteps);
  const StepEvents& events = simulation_.events();
  for (const Collision& collision : events.collisions) {
    spdlog::warn("{}", describe(collision, scenario_));
    summary_.collisions.push_back(collision);
  }
  for (const Stray& stray : events.strays) {
    summary_.warnings.push_back(describe(stray, scenario_));
    spdlog::warn("{}", summary_.warnings.back());
  }
  server_.publish({.k = simulation_.step(),
                   .tick = simulation_.tick(),
                   .links = simulation_.links().row_major(),
                   .ledger_upto = events.ledger_end,
                   .final_step = last_step_,
                   .faults = faults_.begun(),
                   .faults_by_hand = faults_.by_hand()},
                  [this](bus::LockstepServer::DomainIndex domain) { write_samples(domain); });
}

void SimNode::write_samples(bus::LockstepServer::DomainIndex domain) {
  if (domain == kGcsDomain) return gcs_->publish();
  if (domain != kWorldDomain) {
    const UavIndex uav{domain - kFirstUavDomain};
    uavs_[uav]->publish();
    frames_[uav]->publish();
    hand_.publish(uav);
    return;
  }
  gcs_->publish_ledger(inbox_.run());
  viz_->publish();
}

// Gives up the current step, kStopPatience_s after the user asked to end the run, if a member still does not answer:
// its planner may hang, or it may stand still in a debugger.
bool SimNode::gives_up_step() {
  if (!stop_requested_ || elapsed_s(stop_requested_at_) < kStopPatience_s) return false;
  stalled_.clear();
  for (const auto& awaited : server_.awaited()) stalled_.push_back(awaited.member);
  std::string text = fmt::format("interrupted in step {}, which was not finished; it waited for {}", simulation_.step(),
                                 fmt::join(stalled_, " "));
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
  for (const UavIndex i : FirstUavs(uavs_.size())) {
    for (const std::uint64_t capture : uavs_[i]->take_released()) {
      files_.events().add_release(simulation_, uav_names_[i], capture);
      faults_.signals().add_release(i);
      if (work_) work_->add_release(i, capture);
    }
    if (const auto activity = uavs_[i]->take_activity()) {
      const bool news = files_.activities().add(simulation_, i, *activity);
      if (watch_) watch_->add_activity(i, *activity, news);
    }
    for (const auto& [name, value] : uavs_[i]->take_debug()) {
      faults_.signals().set_debug(i, name, value);
      hand_.hear(i, name, value);
    }
  }
  if (work_) work_->end_step([this](const std::string& member) { return server_.is_member(member); });
  faults_.end_step();
  progress_.tell(simulation_, summary_.lost);
}

}  // namespace skein::sim
