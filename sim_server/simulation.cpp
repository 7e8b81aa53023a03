#include "sim_server/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/faults/conditions_change.hpp"
#include "scenes/enclosure.hpp"
#include "sight/moving_clearance.hpp"
#include "sight/ray_scene.hpp"
#include "sim_server/fleet_bodies.hpp"
#include "sim_server/flight/fleet_start.hpp"
#include "sim_server/flight/physics_world.hpp"
#include "sim_server/link_tracer.hpp"
#include "sim_server/simulated_uav.hpp"

namespace skein::sim {
namespace {

/// A UAV idles while it is slower than this and no capture has raised one of its scores for this long.
constexpr double kIdleSpeed = 0.1;
constexpr Tick kIdleAge = 5 * kTicksPerSecond;
/// UAVs whose forces one piece of work computes: for fewer, at a microsecond each, a helper thread does not pay.
constexpr std::size_t kForcesAtOnce = 32;

}  // namespace

struct Simulation::Impl {
  Impl(const Scenario& the_scenario, Scene the_scene, std::uint64_t the_seed, const FaultPlan& the_faults);

  void meet_faults();
  void meet_conditions();
  void deliver_commands();
  void run_tick();
  void control_and_fly();
  void judge_mission();
  void measure(const std::vector<RigidBodyState>& before);
  void take_pictures();
  void take_scans();
  void finish_exchange();
  void trace_links();
  RigidBodyState believed(UavIndex uav) const { return uavs[uav].surroundings.believed(world.state(uav)); }
  void tell(UavIndex uav, const VehicleCondition& condition);
  void refresh_rays();
  void reject(UavIndex uav, RejectionEvent::Command command, std::string reason);
  bool listening(UavIndex uav) const { return mission.alive(uav) && mission.phase() != Phase::ended; }

  const Scenario scenario;
  const Scene scene;
  FaultPlan faults;
  ConditionsConfig conditions;                  ///< the scenario's, as faults have changed them
  std::vector<std::size_t> conditions_changes;  ///< the faults that have changed them
  const std::size_t planned_faults;             ///< without those by hand
  PhysicsWorld world;
  RayScene rays;
  Mission mission;
  Referee referee;
  std::vector<SimulatedUav> uavs;
  std::vector<UavView> views;  ///< at the step boundary
  std::vector<MovingClearance> clearances;
  Links links, open_links;
  LinkTracer tracer;
  std::vector<RejectionEvent> rejections;  ///< since the last advance()
  StepEvents events;
  std::uint64_t step = 0;
  Tick tick = 0;
  WorkClock* clock = nullptr;
  ForEach for_each = one_after_another;
  Tick rays_tick = -1;  ///< the tick whose poses `rays` has
};

Simulation::Impl::Impl(const Scenario& the_scenario, Scene the_scene, std::uint64_t the_seed,
                       const FaultPlan& the_faults)
    : scenario(the_scenario),
      scene(std::move(the_scene)),
      faults(the_faults),
      conditions(scenario.conditions),
      planned_faults(the_faults.faults.size()),
      world(scene.mesh),
      rays(scene.mesh, body_shapes(scenario)),
      mission(scenario, rest_heights(scenario)),
      referee(the_seed, scenario.fleet.size(), scene.points.size(), scenario.rules),
      clearances(scenario.fleet.size(), MovingClearance(kFarClearance_m)),
      tracer(scenario, faults, the_seed) {
  const auto touches = [this](const VehicleConfig& vehicle, const Isometry3d& X_WB) {
    return world.touches_structure(vehicle, X_WB);
  };
  const auto enclosed = [this](const Vector3d& p_WB) { return is_enclosed(rays, p_WB); };
  check_station(scenario, enclosed);
  world.keep_within(world_reach_m(scenario, scene));
  const std::vector<UavStart> starts = draw_fleet_start(scenario, the_seed, touches, enclosed);
  for (const UavIndex i : FirstUavs(starts.size())) {
    const VehicleConfig& vehicle = scenario.fleet[i].vehicle;
    world.add_uav(vehicle, starts[i].X_WB);
    uavs.push_back({.vehicle = Vehicle(vehicle, scenario.rules, kTickS, scenario.exchange_ticks()),
                    .link = CommandLink(starts[i]),
                    .camera = Camera(vehicle.camera, scenario.desired_mm_per_pixel, scenario.rules, scene.points, i,
                                     scenario.conditions.camera, the_seed),
                    .surroundings = Surroundings(scenario, the_seed, i),
                    .lidar = {},
                    .keyframes = {},
                    .view = {},
                    .gimbal_command = {},
                    .condition = {}});
    if (vehicle.lidar) uavs.back().lidar.emplace(*vehicle.lidar, i, the_seed, scenario.conditions.lidar);
  }
  meet_faults();
  take_scans();
  finish_exchange();
}

void Simulation::Impl::meet_faults() {
  if (faults.empty()) return;
  meet_conditions();
  const std::vector<VehicleCondition> faulty = vehicle_conditions(faults, scenario.uav_names(), tick);
  for (const UavIndex i : FirstUavs(uavs.size())) uavs[i].suffer(faulty[i]);
}

void Simulation::Impl::meet_conditions() {
  std::vector<std::size_t> now = active_changes(faults, tick);
  if (now == conditions_changes) return;
  conditions_changes = std::move(now);
  conditions = changed_conditions(faults, scenario, conditions_changes);
  for (SimulatedUav& uav : uavs) uav.change_conditions(conditions);
  tracer.change(conditions.radio);
}

void Simulation::Impl::deliver_commands() {
  for (const UavIndex i : FirstUavs(uavs.size())) {
    SimulatedUav& uav = uavs[i];
    const Commands arrived = uav.link.exchange(tick, uav.condition.command_delay);
    if (!listening(i)) continue;
    if (arrived.gimbal) uav.gimbal_command = arrived.gimbal;
    if (arrived.stop) uav.vehicle.stop();
    if (arrived.trigger) uav.manual_trigger = true;
    uav.triggered |= arrived.trigger && uav.condition.camera_works;
  }
}

void Simulation::Impl::run_tick() {
  control_and_fly();
  const std::vector<RigidBodyState> before = world.states();
  world.tick();
  ++tick;
  judge_mission();
  measure(before);
  if (mission.phase() == Phase::flying) take_pictures();
  if (mission.phase() != Phase::ended) take_scans();
}

void Simulation::Impl::control_and_fly() {
  std::vector<Wrench> wrenches(uavs.size());
  in_blocks(for_each, uavs.size(), kForcesAtOnce,
            [&](std::size_t i) { wrenches[i] = uavs[i].fly(tick, world.state(UavIndex{i}), listening(UavIndex{i})); });
  for (const UavIndex i : FirstUavs(uavs.size())) {
    const RigidBodyState& state = world.state(i);
    world.apply_wrench(i, state.q_WB * wrenches[i].force_B, state.q_WB * wrenches[i].torque_B);
    if (!uavs[i].surroundings.spend(tick, uavs[i].vehicle, state)) continue;
    uavs[i].vehicle.stop();
    mission.lose_power(i);
  }
}

void Simulation::Impl::judge_mission() {
  const bool was_waiting = mission.phase() == Phase::waiting;
  for (const UavIndex i : world.strays()) {
    mission.take_out(i);
    uavs[i].vehicle.stop();
    events.strays.push_back({tick, i, world.state(i).p_WB});
  }
  for (const Collision& collision : mission.update(tick, world.states(), world.contacts())) {
    uavs[collision.uav].vehicle.stop();
    referee.enter_collision(collision.uav, tick);
    events.collisions.push_back(collision);
  }
  if (was_waiting && mission.phase() == Phase::flying) {
    for (SimulatedUav& uav : uavs) uav.last_raise = tick;
  }
  if (mission.end_tick() == tick)
    for (SimulatedUav& uav : uavs) uav.vehicle.stop();
}

void Simulation::Impl::measure(const std::vector<RigidBodyState>& before) {
  if (mission.phase() != Phase::flying) return;
  for (const UavIndex i : FirstUavs(uavs.size())) {
    if (!mission.alive(i)) continue;
    SimulatedUav& uav = uavs[i];
    const RigidBodyState& state = world.state(i);
    const double speed = state.v_WB.norm();
    if (mission.airborne(i)) {
      uav.view.distance_m += (state.p_WB - before[i].p_WB).norm();
      uav.view.max_speed_mps = std::max(uav.view.max_speed_mps, speed);
    }
    if (speed < kIdleSpeed && tick - uav.last_raise > kIdleAge) ++uav.idle_ticks;
  }
}

void Simulation::Impl::take_pictures() {
  const Tick shutter_delay = ticks(conditions.camera.shutter_delay_s);
  std::vector<UavIndex> firing;
  for (const UavIndex i : FirstUavs(uavs.size())) {
    SimulatedUav& uav = uavs[i];
    if (!mission.alive(i) || !uav.condition.camera_works) continue;
    if (uav.shutter_opens(tick, shutter_delay)) firing.push_back(i);
  }
  if (firing.empty()) return;
  refresh_rays();
  auto captures = [&] {
    const WorkSection section(clock, Work::camera, firing.size());
    return all_of<Capture>(for_each, firing, [&](UavIndex i) {
      return uavs[i].camera.capture(tick, world.state(i), uavs[i].vehicle.gimbal(), rays,
                                    uavs[i].surroundings.other_states(world.state(i)), &referee.poor_pictures());
    });
  }();
  for (std::size_t n = 0; n < firing.size(); ++n) {
    const UavIndex i = firing[n];
    referee.note_poor(captures[n]);
    if (captures[n].detections.empty()) continue;
    ++uavs[i].view.captures;
    if (captures[n].improved()) uavs[i].last_raise = tick;
    auto report = referee.enter(i, captures[n]);
    events.captures.push_back(
        {i, std::move(captures[n]), uavs[i].surroundings.X_told_W(world.state(i)), std::move(report)});
  }
}

void Simulation::Impl::take_scans() {
  std::vector<UavIndex> scanning;
  for (const UavIndex i : FirstUavs(uavs.size())) {
    SimulatedUav& uav = uavs[i];
    if (!uav.lidar || !mission.alive(i)) continue;
    uav.lidar->move(tick, world.state(i).X_WB());
    if (!uav.condition.lidar_works || !uav.lidar->due(tick)) continue;
    events.servos.push_back({i, uav.lidar->servo(tick)});
    if (uav.scans_wanted || uav.keyframes.wants(tick, uav.X_told_B(world.state(i)))) scanning.push_back(i);
  }
  if (scanning.empty()) return;
  refresh_rays();
  auto scans = [&] {
    const WorkSection section(clock, Work::lidar, scanning.size());
    return all_of<LidarScan>(for_each, scanning,
                             [&](UavIndex i) { return uavs[i].lidar->scan(tick, world.state(i).X_WB(), rays); });
  }();
  for (std::size_t n = 0; n < scans.size(); ++n) {
    const UavIndex i = scanning[n];
    if (const auto X_told_W = uavs[i].surroundings.X_told_W(world.state(i))) place(scans[n], *X_told_W);
    if (auto key_frame = uavs[i].keyframes.offer(scans[n], uavs[i].X_told_B(world.state(i)))) {
      events.key_frames.push_back({i, std::move(*key_frame), {}});
    }
    events.scans.push_back({i, std::move(scans[n])});
  }
}

void Simulation::Impl::finish_exchange() {
  meet_conditions();
  trace_links();
  const auto faulty = vehicle_conditions(faults, scenario.uav_names(), tick);  // of the exchange that begins
  std::vector<UavView> now;
  for (const UavIndex i : FirstUavs(uavs.size())) {
    UavView& view = uavs[i].view;
    view.state = world.state(i);
    if (mission.alive(i)) uavs[i].surroundings.note_place(tick, world.state(i).p_WB, mission.airborne(i));
    tell(i, faulty[i]);
    view.gimbal = uavs[i].vehicle.gimbal();
    view.alive = mission.alive(i);
    view.airborne = mission.airborne(i);
    view.idle_s = seconds(uavs[i].idle_ticks);
    view.command_latency = uavs[i].link.latency(faulty[i].command_delay);
    now.push_back(view);
    view.setpoint.reset();
  }
  views = std::move(now);
  for (KeyFrameEvent& event : events.key_frames) {
    for (const UavIndex uav : FirstUavs(uavs.size())) {
      if (open_links.at(node_of_uav(event.uav), node_of_uav(uav)) != 0) event.neighbours.push_back(uav);
    }
  }
  events.ledger_end = referee.ledger().size();
}

void Simulation::Impl::trace_links() {
  const WorkSection section(clock, Work::links);
  refresh_rays();
  std::vector<LinkTracer::Place> places;
  for (const UavIndex i : FirstUavs(uavs.size())) places.push_back({world.state(i).p_WB, mission.alive(i)});
  links = tracer.trace(tick, rays, places, for_each);
  open_links = tracer.open(tick, links);
}

/// Updates the state that the UAV's on-board software receives, with its uncertainty, the battery and the wind.
void Simulation::Impl::tell(UavIndex i, const VehicleCondition& condition) {
  const Surroundings& surroundings = uavs[i].surroundings;
  const ToldState told = uavs[i].surroundings.tell(tick, world.state(i));
  UavView& view = uavs[i].view;
  view.told_tick = told.tick;
  view.uncertainty = surroundings.uncertainty();
  view.battery = surroundings.battery();
  view.battery_use = surroundings.battery_use();
  view.wind_W = surroundings.wind_estimate_W();
  if (condition.odometry_frozen && step > 0) return;
  view.told = told.state;
  view.told.p_WB += condition.odometry_offset_m;
}

void Simulation::Impl::refresh_rays() {
  if (rays_tick == tick) return;
  for (const UavIndex i : FirstUavs(uavs.size())) rays.set_pose(i, world.state(i).X_WB());
  rays_tick = tick;
}

void Simulation::Impl::reject(UavIndex uav, RejectionEvent::Command command, std::string reason) {
  UavView& view = uavs[uav].view;
  if (!view.first_rejected) view.first_rejected = tick;
  rejections.push_back({uav, command, std::move(reason), ++view.commands_rejected});
}

Simulation::Simulation(const Scenario& scenario, Scene scene, std::uint64_t seed, const FaultPlan& faults)
    : impl_(std::make_unique<Impl>(scenario, std::move(scene), seed, faults)) {}
Simulation::~Simulation() = default;

bool Simulation::command_trajectory(UavIndex uav, const TrajectoryCommand& command) {
  if (!impl_->listening(uav)) return true;
  if (auto reason = impl_->uavs[uav].vehicle.refuse(command, impl_->believed(uav))) {
    impl_->reject(uav, RejectionEvent::Command::trajectory, std::move(*reason));
    return false;
  }
  impl_->uavs[uav].link.outbox().trajectory = impl_->uavs[uav].view.setpoint = command;
  return true;
}

bool Simulation::command_gimbal(UavIndex uav, const GimbalCommand& command) {
  if (!impl_->listening(uav)) return true;
  if (!std::isfinite(command.pitch) || !std::isfinite(command.yaw)) {
    impl_->reject(uav, RejectionEvent::Command::gimbal, "a gimbal command must consist of finite numbers");
    return false;
  }
  impl_->uavs[uav].link.outbox().gimbal = command;
  return true;
}

void Simulation::trigger_camera(UavIndex uav) { impl_->uavs[uav].link.outbox().trigger = true; }
void Simulation::stop(UavIndex uav) { impl_->uavs[uav].link.outbox().stop = true; }

void Simulation::set_off(std::size_t fault, Tick tick) { impl_->faults.faults.at(fault).set_off(tick); }
void Simulation::set_faults_by_hand(const std::vector<Fault>& faults) {
  std::vector<Fault>& all = impl_->faults.faults;
  all.resize(impl_->planned_faults);
  all.insert(all.end(), faults.begin(), faults.end());
}
void Simulation::want_scans(UavIndex uav, bool wanted) { impl_->uavs[uav].scans_wanted = wanted; }
void Simulation::share_work(ForEach for_each) { impl_->for_each = std::move(for_each); }
void Simulation::watch(WorkClock* clock) { impl_->clock = clock; }

void Simulation::advance() {
  Impl& self = *impl_;
  const WorkSection section(self.clock, Work::simulation);
  self.events = {};
  self.events.rejections = std::exchange(self.rejections, {});
  self.events.ledger_begin = self.referee.ledger().size();
  ++self.step;
  for (SimulatedUav& uav : self.uavs) uav.surroundings.begin_exchange();
  self.meet_faults();
  self.deliver_commands();
  for (Tick end = self.tick + self.scenario.exchange_ticks(); self.tick < end;) self.run_tick();
  self.finish_exchange();
}

std::uint64_t Simulation::step() const { return impl_->step; }
Tick Simulation::tick() const { return impl_->tick; }
std::size_t Simulation::size() const { return impl_->uavs.size(); }
const Mission& Simulation::mission() const { return impl_->mission; }
const UavView& Simulation::uav(UavIndex i) const { return impl_->views.at(i); }
std::span<const UavView> Simulation::uavs() const { return impl_->views; }
const Camera& Simulation::camera(UavIndex i) const { return impl_->uavs.at(i).camera; }
const Links& Simulation::links() const { return impl_->links; }
const Links& Simulation::open_links() const { return impl_->open_links; }
std::optional<LinkQuality> Simulation::link_quality(Node from, Node to) const {
  return impl_->tracer.quality(impl_->open_links.at(from, to), from, to);
}
const Links& Simulation::unfailed_links() const { return impl_->tracer.unfailed(); }
double Simulation::clearance(UavIndex uav) const {
  return impl_->clearances.at(uav).at(impl_->rays, impl_->views.at(uav).state.p_WB);
}
const FaultPlan& Simulation::faults() const { return impl_->faults; }
const StepEvents& Simulation::events() const { return impl_->events; }
const Referee& Simulation::referee() const { return impl_->referee; }
const Scene& Simulation::scene() const { return impl_->scene; }
const RayScene& Simulation::rays() const { return impl_->rays; }

DigestInput Simulation::digest_input() const {
  DigestInput input;
  input.k = impl_->step;
  for (const UavView& uav : impl_->views) input.uavs.push_back({uav.state, uav.gimbal, uav.alive});
  const StepEvents& events = impl_->events;
  input.ledger =
      std::span(impl_->referee.ledger()).subspan(events.ledger_begin, events.ledger_end - events.ledger_begin);
  return input;
}

}  // namespace skein::sim
