#include "sim_server/watch_node.hpp"

#include <spdlog/spdlog.h>

#include "bus/lockstep/names.hpp"
#include "bus/typed.hpp"
#include "core/messages/view_topics.hpp"
#include "core/scoring/camera_quality.hpp"
#include "core/topics.hpp"
#include "results/run_tables.hpp"
#include "sim_server/record/run_files.hpp"

namespace skein::sim {
namespace {

/// Least time between two state messages: the page does not draw more often.
constexpr std::chrono::milliseconds kStatePeriod{80};
/// Maximum number of orders about faults that are kept until the next boundary; no person is faster.
constexpr std::size_t kMostFaultOrders = 64;
const Tick kPosePeriod = ticks(view::kTrailPeriod_s);
/// Least time between two messages about the radio links: those of a large fleet change in nearly every step.
const Tick kLinksPeriod = ticks(0.25);

/// The scene as of the start of a run, when no point has been seen.
results::RunRecord scene_of(const Scenario& scenario, const Scene& scene) {
  results::RunRecord run;
  for (const UavConfig& uav : scenario.fleet) {
    run.uavs.push_back(uav.name);
    run.explorer.push_back(uav.vehicle.role == Role::explorer);
  }
  for (const OrientedBox& box : scene.boxes) run.boxes.push_back({box.name, box.center, box.size, box.R_WO});
  for (const InterestPoint& point : scene.points) {
    results::RunPoint shown;
    shown.p_W = point.p_W.cast<double>();
    shown.normal_W = point.n_W.cast<double>();
    run.points.push_back(shown);
  }
  run.station = scenario.station_position;
  return run;
}

}  // namespace

WatchNode::WatchNode(const Scenario& scenario, const Simulation& simulation, EventLog& events, bus::Inbox& inbox,
                     bus::Participant& world, std::span<const std::unique_ptr<bus::Participant>> uavs,
                     const WatchOptions& options, FaultNode& faults, HandNode& hand)
    : scenario_(scenario),
      simulation_(simulation),
      options_(options),
      hand_(hand),
      pace_(options.paced ? options.speed : std::nullopt, options.pause_at_s),
      look_(scenario, simulation, world, uavs),
      story_(world.create_writer(bus::spec(topics::view_story()))),
      state_(world.create_writer(bus::spec(topics::view_state()))),
      faults_(faults),
      sayings_(scenario.fleet.size()) {
  orders_ =
      bus::subscribe<msg::String>(inbox, world, bus::spec(topics::view_orders()), [this](const msg::String& text) {
        if (const auto order = view::read_order(text.data())) obey(*order);
      });
  events.tell([this](const LoggedEvent& event) {
    if (event.event != run_tables::kJoined && event.event != run_tables::kLeft) return;
    if (event.subject == bus::kStationName) station_there_ = event.event == run_tables::kJoined;
    tell(view::event_line(seconds(event.tick), event.event, event.subject, event.object));
  });
  tell_scene();
  if (options.losses) estimate_.emplace(scenario, simulation.scene(), estimate_request());
}

void WatchNode::obey(const view::Order& order) {
  if (const auto* look = std::get_if<view::LookOrder>(&order)) return look_.obey(*look, Clock::now());
  if (const auto* time = std::get_if<view::TimeOrder>(&order); time != nullptr && options_.paced) pace_.obey(*time);
  if (const auto* fly = std::get_if<view::FlyOrder>(&order)) hand_.take(*fly);
  const auto* fault = std::get_if<view::FaultOrder>(&order);
  if (fault != nullptr && fault_orders_.size() < kMostFaultOrders) fault_orders_.push_back(*fault);
  state_stale_ = true;
}

bool WatchNode::obey_fault_orders() {
  bool done = false;
  for (const view::FaultOrder& order : std::exchange(fault_orders_, {})) {
    const std::string reason = faults_.obey(order);
    done = done || reason.empty();
    ++(reason.empty() ? done_ : refused_);
    if (!reason.empty()) refusal_ = reason;
  }
  return done;
}

void WatchNode::tell(const std::string& line) {
  msg::String text;
  text.data(line);
  story_->write(encode(text));
}

void WatchNode::tell_scene() {
  std::vector<CameraConfig> cameras;
  std::vector<double> range_m;
  for (const UavConfig& uav : scenario_.fleet) {
    cameras.push_back(uav.vehicle.camera);
    range_m.push_back(resolution_distance(uav.vehicle.camera, scenario_.desired_mm_per_pixel));
  }
  Json scene = view::scene_json(scene_of(scenario_, simulation_.scene()), cameras, range_m);
  scene["clouds"] = look_.offer();
  scene["mode"] = "live";
  scene["paced"] = options_.paced;
  scene["scenario"] = scenario_.name;
  scene["duration"] = scenario_.duration_s;
  if (hand_.flies()) scene["by_hand"] = hand_.names();
  tell(scene.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void WatchNode::tell_estimate() {
  if (!estimate_ || !estimate_->over()) return;
  const auto summary = estimate_->take();
  estimate_.reset();
  if (summary) tell(view::estimate_line(seconds(simulation_.tick()), summary->estimate, summary->flyable));
}

std::vector<view::ShownUav> WatchNode::shown_uavs() const {
  std::vector<view::ShownUav> shown;
  for (const UavView& uav : simulation_.uavs()) shown.push_back({uav.state, uav.gimbal, uav.alive});
  return shown;
}

std::vector<view::ShownLink> WatchNode::shown_links() const {
  using view::ShownLink;
  const auto is_dead = [this](Node node) {
    const auto uav = uav_of_node(node);
    return uav && !simulation_.uav(*uav).alive;
  };
  std::vector<ShownLink> shown;
  for (const Node from : scenario_.nodes()) {
    for (const Node to : scenario_.nodes()) {
      const bool there = simulation_.unfailed_links().at(from, to) != 0,
                 open = simulation_.open_links().at(from, to) != 0;
      shown.push_back(is_dead(from) || is_dead(to) ? ShownLink::dead
                      : open                       ? ShownLink::linked
                      : there                      ? ShownLink::cut
                                                   : ShownLink::blocked);
    }
  }
  return shown;
}

void WatchNode::begin_step(const std::vector<std::string>& faults) {
  look_.begin_step();
  const double now_s = seconds(simulation_.tick());
  for (const std::string& fault : faults) tell(view::event_line(now_s, "fault", fault, ""));
  for (const auto& [fault, begins] : faults_.changes()) tell(view::fault_line(now_s, fault, begins));
  for (const Collision& collision : simulation_.events().collisions) {
    tell(view::event_line(seconds(collision.tick), "collision", scenario_.fleet[collision.uav].name,
                          collided_with(collision, scenario_)));
  }
  if (simulation_.tick() >= links_due_ || pace_.paused()) {
    if (std::vector<view::ShownLink> links = shown_links(); links != told_links_) {
      tell(view::links_line(now_s, links));
      told_links_ = std::move(links);
      links_due_ = simulation_.tick() + kLinksPeriod;
    }
  }
  if (simulation_.tick() >= pose_due_) {
    tell(view::pose_line(now_s, shown_uavs()));
    pose_due_ = simulation_.tick() + kPosePeriod;
  }
  tell_estimate();
  state_stale_ = true;
  const auto now = Clock::now();
  end_wait(now);
  if (now - state_told_ >= kStatePeriod) tell_state(now);
}

void WatchNode::add_activity(UavIndex uav, const Activity& activity, bool news) {
  if (!sayings_[uav]) sayings_[uav].emplace();
  sayings_[uav]->activity = activity;
  sayings_[uav]->cpu.add(simulation_.tick(), activity.cpu_s);
  if (news) tell(view::activity_line(seconds(simulation_.tick()), uav, activity));
}

void WatchNode::wait_for(const std::vector<AwaitedMember>& awaited, const std::string& what) {
  awaited_.clear();
  for (const AwaitedMember& one : awaited) awaited_.push_back(one.name);
  awaited_what_ = what;
  tell_state(Clock::now());
}

void WatchNode::end_wait(Clock::time_point now) {
  if (awaited_.empty()) return;
  awaited_.clear();
  tell_state(now);
}

/// The members for which the server waits; empty: none.
std::string WatchNode::waits_json() const {
  if (awaited_.empty()) return "";
  return ",\"waits\":" +
         Json{{"for", awaited_}, {"what", awaited_what_}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string WatchNode::activities_json() const {
  std::vector<std::optional<view::ShownNumbers>> numbers;
  for (const auto& saying : sayings_) {
    numbers.emplace_back();
    if (!saying) continue;
    numbers.back() = {saying->activity.speed_mps, saying->activity.undelivered, saying->cpu.per_s()};
  }
  return view::numbers_json(numbers);
}

/// The faults by hand that a viewer may end, and why the last refused order was refused.
std::string WatchNode::faults_json() const {
  Json open = Json::array();
  for (const HandFault& one : faults_.open_by_hand()) {
    Json shown = {{"n", one.number},
                  {"kind", fault_kind(one.fault)},
                  {"of", fault_target(one.fault)},
                  {"t", one.fault.at_s},
                  {"begun", one.fault.begin() <= simulation_.tick()}};
    if (one.fault.until_s) shown["until"] = *one.fault.until_s;
    open.push_back(std::move(shown));
  }
  const Json faults = {{"open", std::move(open)}, {"done", done_}, {"refused", refused_}, {"why", refusal_}};
  return faults.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void WatchNode::tell_state(Clock::time_point now) {
  const Mission& mission = simulation_.mission();
  const double mission_s = mission.start_tick() ? seconds(simulation_.tick() - *mission.start_tick()) : 0.0;
  msg::String text;
  text.data(fmt::format(R"({{"t":{:.3f},"tick":{},"mission":{:.3f},"phase":"{}","paused":{},"speed":"{}",)"
                        R"("faults":{},"u":{},"a":{}{}{}}})",
                        seconds(simulation_.tick()), simulation_.tick(), mission_s, name_of(mission.phase()),
                        pace_.paused(), view::speed_text(pace_.speed()), faults_json(), view::poses_json(shown_uavs()),
                        activities_json(), hand_.flies() ? ",\"hand\":" + hand_.state_json() : "", waits_json()));
  state_->write(encode(text));
  state_told_ = now;
  state_stale_ = false;
}

bool WatchNode::may_go_on() {
  const auto now = Clock::now();
  end_wait(now);
  look_.tell(now);
  if (!options_.paced) return true;
  if (pace_.reach(seconds(simulation_.tick()))) state_stale_ = true;
  if (pace_.paused() && !station_there_) {
    pace_.let_go(now);
    return true;
  }
  const bool goes = pace_.may_go_on(now, seconds(scenario_.exchange_ticks()));
  if (!goes && state_stale_ && (pace_.paused() || now - state_told_ >= kStatePeriod)) tell_state(now);
  return goes;
}

std::chrono::milliseconds WatchNode::left() const {
  return std::chrono::ceil<std::chrono::milliseconds>(pace_.left(Clock::now()));
}

}  // namespace skein::sim
