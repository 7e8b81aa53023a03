#include "uav_agent/onboard/agent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iterator>

#include "core/math/euler.hpp"
#include "uav_agent/api/learner.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/flight_core/flight_core.hpp"
#include "uav_agent/flight_core/tracker.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/own_trail.hpp"
#include "uav_agent/maps/uav_traces.hpp"
#include "uav_agent/maps/world_mapper.hpp"
#include "uav_agent/onboard/activity.hpp"
#include "uav_agent/onboard/beam_reader.hpp"
#include "uav_agent/onboard/key_frame_filter.hpp"
#include "uav_agent/onboard/map_radio.hpp"
#include "uav_agent/onboard/ready_frames.hpp"
#include "uav_agent/onboard/uplink.hpp"
#include "uav_agent/planning/aiming.hpp"

namespace skein::agent {
namespace {

constexpr double kBodyMarginM = 0.3;  ///< margin around a known body; chosen
constexpr double kGroundM = 0.3;      ///< hits of a LiDAR below this height are the ground; chosen
constexpr double kScanAgeS = 0.1;     ///< a scan is at most this much older than the known positions of UAVs; sensor
constexpr double kBodySigmas = 3.0;   ///< standard deviations of the relative position that enlarge a body; chosen
constexpr double kWaitBreak_s = 0.5;  ///< a planner that waits again within this time has not stopped; chosen
constexpr double kTie_s = 1e-6;       ///< against rounding: times less than this apart are equal

WorldMap::Config world_map_config() {
  WorldMap::Config config;
  config.ground_m = kGroundM;
  return config;
}

KnownBody known_body(const Vector3d& p_W, const Vector3d& v_W, double radius_m) {
  return {p_W, radius_m + kBodyMarginM + kScanAgeS * v_W.norm()};
}

}  // namespace

struct Agent::Impl {
  Impl(const AgentConfig& c, std::unique_ptr<Planner> p, std::shared_ptr<ReadyFrames> f)
      : config(c),
        planner(std::move(p)),
        frames(f ? std::move(f) : std::make_shared<ReadyFrames>()),
        peers(c),
        tracker(tracker_config(c.vehicle)) {
    if (planner->flight()) core = std::make_unique<FlightCore>(*planner->flight(), config);
    const bool maps_world = core || planner->wants_world_map();
    const auto& lidar = config.vehicle.lidar;
    if (lidar && (planner->wants_beams() || maps_world)) beam_reader.emplace(*lidar);
    if (!maps_world) return;
    if (lidar) {
      world_mapper = std::make_unique<WorldMapper>(
          *lidar, WorldMapper::Config{.map = world_map_config(), .clutter = config.lidar_clutter});
    } else {
      world_map = std::make_unique<WorldMap>(world_map_config());
    }
    map_radio.emplace(config);
    uav_traces.emplace(config, known_world()->config().cell_m);
    known_world()->on_met([this](const Eigen::Vector3i& cube, bool news) { uav_traces->met(cube, news); });
    own_trail.emplace(config, known_world()->config().cell_m);
    known_world()->ignore_reports([this](const Eigen::Vector3i& cube) { return own_trail->contains(cube); });
  }

  void read_radio(const AgentInput& input);
  void read_beams(const AgentInput& input);
  void clear_own_place(const Vector3d& p_W);
  void perceive(const AgentInput& input);
  void take_in(const AgentInput& input);
  WorldMap* known_world() { return world_mapper ? &world_mapper->map() : world_map.get(); }
  const WorldMap* known_world() const { return world_mapper ? &world_mapper->map() : world_map.get(); }
  std::optional<RadioMessage> tell_map(const std::optional<Vector3d>& going_to_W, Tick tick);
  std::vector<KnownBody> other_bodies(const PoseUncertainty& uncertainty) const;
  std::vector<KnownBody> known_bodies(const AgentInput& input) const;
  std::optional<Vector3d> sensor_position(const KeyFrame& frame, const AgentInput& input) const;
  PlannerInput planner_input(const AgentInput& input) const;
  PlannerOutput plan(const PlannerInput& in);
  void fly(const PlannerInput& in, PlannerOutput& decision);
  std::optional<TrajectoryCommand> move(const PlannerOutput& decision, const AgentInput& input);
  std::optional<GimbalCommand> point_camera(const GimbalAim& new_aim, const RigidBodyState& state);
  void wait_for(std::size_t mate, double now_s);
  void note_motion(const Motion& motion);
  ActivityFacts facts(const PlannerInput& in, const std::optional<std::size_t>& waits_for) const;

  const AgentConfig config;
  const std::unique_ptr<Planner> planner;
  const std::shared_ptr<ReadyFrames> frames;
  Peers peers;
  OccupancyMap map;
  std::optional<BeamReader> beam_reader;      ///< if beams or the world map are wanted and there is a LiDAR
  std::deque<Scan> scans_ahead;               ///< scans that are newer than the newest odometry
  std::vector<BeamScan> beam_scans;           ///< of this exchange
  std::unique_ptr<WorldMapper> world_mapper;  ///< if the world map is wanted and there is a LiDAR
  std::unique_ptr<WorldMap> world_map;        ///< if the world map is wanted and there is no LiDAR
  std::optional<MapRadio> map_radio;          ///< if the world map is wanted
  std::optional<UavTraces> uav_traces;        ///< if the world map is wanted
  std::optional<OwnTrail> own_trail;          ///< if the world map is wanted
  std::vector<RadioMessage> planners_radio;   ///< of this exchange, without messages of map sharing
  Uplink uplink;
  Tracker tracker;
  std::unique_ptr<FlightCore> core;  ///< if it flies this UAV for the planner
  std::vector<OrientedBox> boxes;
  GimbalAim aim;
  double waited_s = 0.0;
  std::vector<WaitSpan> waits;
  std::map<std::string, std::uint64_t> no_ways;
  std::string no_way;
  OwnMotion own_motion;  ///< if there is no core
  ActivityTeller activity{config.fleet};
  std::optional<FreeSpace> space;        ///< PlannerInput::space of `taken_in`, if there is a core
  std::optional<PlannerInput> taken_in;  ///< input of the current step, from look() or step() to the step's end
  std::unique_ptr<WorkParts> parts;      ///< nullptr: parts of the work are not timed
};

void Agent::Impl::wait_for(std::size_t mate, double now_s) {
  waited_s += config.exchange_period_s;
  const bool on = !waits.empty() && waits.back().mate == mate && now_s < waits.back().until_s + kWaitBreak_s + kTie_s;
  if (!on) waits.push_back({now_s, now_s, mate});
  waits.back().until_s = now_s + config.exchange_period_s;
}

std::vector<KnownBody> Agent::Impl::other_bodies(const PoseUncertainty& uncertainty) const {
  std::vector<KnownBody> bodies;
  for (const Peer& peer : peers.all()) {
    // A UAV that this UAV has never seen is assumed to be at its start.
    if (!peer.visible && peer.seen) continue;
    // Returns from another UAV must not become structure, which the map would never forget.
    const double off_m = kBodySigmas * relative_deviation_m(uncertainty, peer).maxCoeff();
    bodies.push_back(known_body(peer.p_W, peer.v_W, config.fleet[peer.uav].body_radius_m + off_m));
  }
  return bodies;
}

std::vector<KnownBody> Agent::Impl::known_bodies(const AgentInput& input) const {
  std::vector<KnownBody> bodies = other_bodies(input.uncertainty);
  bodies.insert(bodies.begin(), known_body(input.state.p_WB, input.state.v_WB, config.me().body_radius_m));
  return bodies;
}

void Agent::Impl::read_radio(const AgentInput& input) {
  const PartTimer timer(parts.get(), "maps/others' maps");
  if (map_radio) map_radio->hear(input.radio, input.tick, *known_world());
  planners_radio.clear();
  std::ranges::remove_copy_if(input.radio, std::back_inserter(planners_radio), MapRadio::is_of_maps);
}

void Agent::Impl::read_beams(const AgentInput& input) {
  const PartTimer timer(parts.get(), "maps/own beams");
  beam_scans.clear();
  if (!beam_reader) return;
  const Tick state_tick = input.state_tick.value_or(input.tick);
  beam_reader->hear(state_tick, input.state);
  for (const LidarServo& servo : input.servos) beam_reader->hear(servo);
  scans_ahead.insert(scans_ahead.end(), input.scans.begin(), input.scans.end());
  if (scans_ahead.empty() || scans_ahead.front().tick > state_tick) return;
  const std::vector<KnownBody> others = other_bodies(input.uncertainty);
  for (; !scans_ahead.empty() && scans_ahead.front().tick <= state_tick; scans_ahead.pop_front()) {
    beam_scans.push_back(beam_reader->read(scans_ahead.front(), others));
    if (world_mapper) world_mapper->insert(beam_scans.back());
  }
}

/// A UAV that did not know this UAV's position may have mapped this UAV's body as structure, and reported it by radio.
/// But the place where this UAV is must be free; otherwise it could never leave that place.
void Agent::Impl::clear_own_place(const Vector3d& p_W) {
  WorldMap& world = *known_world();
  if (world.structure_distance_m(p_W) > config.me().body_radius_m) return;
  world.vacate(p_W, config.me().body_radius_m);
  world.set_free(p_W, config.me().body_radius_m);
}

void Agent::Impl::perceive(const AgentInput& input) {
  const PartTimer timer(parts.get(), "maps/other");
  if (tracker.stands_by()) tracker.stand_by(input.state);
  peers.update(input.tick, input.neighbours, input.links);
  if (world_map && world_map->regions().empty()) {
    world_map->set_free(input.state.p_WB, WorldMapper::Config().start_clear_m);
  }
  if (uav_traces) uav_traces->update(input.tick, peers);
  if (own_trail) own_trail->update(input.tick, peers, input.state.p_WB);
  read_radio(input);
  read_beams(input);
  if (uav_traces) uav_traces->doubt(*known_world());
  if (known_world()) clear_own_place(input.state.p_WB);
  if (!input.boxes.empty()) boxes = input.boxes;
  if (!input.key_frames.empty()) {
    const KnownBodies bodies(known_bodies(input));
    // An isolated hit may be on a UAV out of sight. But it may also be all that a distant LiDAR sees of a thin member.
    // If one box contains a whole site, UAVs fly between members that LiDARs saw only from afar: then keep such hits.
    const bool keep_lone = std::any_of(boxes.begin(), boxes.end(), is_site_box);
    for (const KeyFrame& frame : input.key_frames) {
      auto sound_W = frames->filter(keep_lone).sound(frame.points_W, bodies);
      const std::optional<Vector3d> p_WS = sensor_position(frame, input);
      map.insert(*frames->ready(std::move(sound_W), p_WS, keep_lone));
    }
  }
  uplink.take(input.capture_reports);
  uplink.acknowledge(input.capture_acks);
}

std::optional<Vector3d> Agent::Impl::sensor_position(const KeyFrame& frame, const AgentInput& input) const {
  if (frame.source == node_of_uav(config.self)) return input.state.p_WB;
  std::vector<Vector3d> with_lidar;
  for (const Neighbour& neighbour : input.neighbours) {
    if (frame.source == neighbour.node) return neighbour.p_W;
    const bool in_fleet = neighbour.node != kStationNode && neighbour.node <= config.fleet.size();
    if (in_fleet && config.fleet[neighbour.node - 1].role == Role::explorer) with_lidar.push_back(neighbour.p_W);
  }
  if (frame.p_WS) return frame.p_WS;
  return with_lidar.size() == 1 ? std::optional(with_lidar.front()) : std::nullopt;
}

PlannerInput Agent::Impl::planner_input(const AgentInput& input) const {
  return PlannerInput{.k = input.k,
                      .tick = input.tick,
                      .state = input.state,
                      .gimbal = input.gimbal,
                      .tracking = tracker.tracking(),
                      .map = map,
                      .boxes = boxes,
                      .peers = peers,
                      .mission_remaining_s = input.mission_remaining_s,
                      .station_linked = peers.station_visible(),
                      .undelivered_captures = uplink.undelivered(),
                      .detected = input.detected,
                      .radio = planners_radio,
                      .key_frames = input.key_frames,
                      .scans = planner->wants_scans() ? std::span(input.scans) : std::span<const Scan>(),
                      .beam_scans = planner->wants_beams() ? std::span(beam_scans) : std::span<BeamScan>(),
                      .world_map = known_world(),
                      .scanned = !beam_scans.empty(),
                      .hand = input.hand,
                      .uncertainty = input.uncertainty,
                      .battery = input.battery,
                      .wind_W = input.wind_W,
                      .station_link = peers.station_link(),
                      .parts = parts.get()};
}

PlannerOutput Agent::Impl::plan(const PlannerInput& in) {
  const PartTimer timer(parts.get(), "planner/other");
  return planner->plan(in);
}

/// Lets the flight core fly to the planner's goals: replaces the planner's motion with the core's.
void Agent::Impl::fly(const PlannerInput& in, PlannerOutput& decision) {
  const PartTimer timer(parts.get(), "flight/other");
  Steering steering = core->step(in, std::move(decision.goals), decision.stake);
  decision.motion = std::move(steering.motion);
  if (steering.yaw) decision.yaw = steering.yaw;
  if (!std::holds_alternative<std::monostate>(steering.gimbal)) decision.gimbal = steering.gimbal;
  if (!decision.waits_for) decision.waits_for = core->waits_for();
  decision.going_to_W = core->going_to_W();
  if (decision.no_way.empty()) decision.no_way = core->no_way();
}

void Agent::Impl::note_motion(const Motion& motion) {
  using enum OwnMotion::Kind;
  constexpr std::array kKinds = {none, setpoint, path, hold, command};  // in the order of Motion
  if (std::holds_alternative<std::monostate>(motion)) return;
  own_motion = {kKinds.at(motion.index()), {}};
  const auto* way = std::get_if<Path>(&motion);
  if (way != nullptr && !way->waypoints.empty()) own_motion.end_W = way->waypoints.back().p_WB;
}

ActivityFacts Agent::Impl::facts(const PlannerInput& in, const std::optional<std::size_t>& waits_for) const {
  ActivityFacts facts{.tick = in.tick,
                      .what = own_motion,
                      .p_WB = in.state.p_WB,
                      .speed_mps = in.state.v_WB.norm(),
                      .undelivered = in.undelivered_captures,
                      .waits_for = waits_for,
                      .no_way = no_way};
  if (core) {
    facts.what = core->doing(in);
    facts.held = core->filter().held();
  } else if (tracker.tracking().done) {
    std::get<OwnMotion>(facts.what).end_W.reset();
  }
  return facts;
}

std::optional<TrajectoryCommand> Agent::Impl::move(const PlannerOutput& decision, const AgentInput& input) {
  const RigidBodyState& state = input.state;
  if (const auto* command = std::get_if<TrajectoryCommand>(&decision.motion)) {
    tracker.stand_by(state);
    return *command;
  }
  if (decision.yaw) tracker.turn_to(*decision.yaw);
  if (const auto* path = std::get_if<Path>(&decision.motion)) tracker.follow(*path);
  if (const auto* setpoint = std::get_if<Setpoint>(&decision.motion)) tracker.fly_to(*setpoint);
  if (std::holds_alternative<Hold>(decision.motion)) tracker.hold();
  if (!core) return tracker.step(state, config.exchange_period_s);
  const PartTimer timer(parts.get(), "flight/safety filter");
  return core->move(tracker,
                    {.tick = input.tick, .state = state, .map = *known_world(), .boxes = boxes, .peers = peers});
}

std::optional<RadioMessage> Agent::Impl::tell_map(const std::optional<Vector3d>& going_to_W, Tick tick) {
  if (!map_radio) return std::nullopt;
  const PartTimer timer(parts.get(), "maps/telling");
  const TrackingState tracking = tracker.tracking();
  const std::optional<Vector3d> setpoint_W = tracking.airborne ? std::optional(tracking.setpoint.p_WB) : std::nullopt;
  return map_radio->tell(*known_world(), peers, going_to_W ? going_to_W : setpoint_W, tick);
}

std::optional<GimbalCommand> Agent::Impl::point_camera(const GimbalAim& new_aim, const RigidBodyState& state) {
  if (!std::holds_alternative<std::monostate>(new_aim)) aim = new_aim;
  if (const auto* command = std::get_if<GimbalCommand>(&aim)) return *command;
  if (const auto* point = std::get_if<Vector3d>(&aim)) return aim_at(*point, state, config.vehicle);
  return std::nullopt;
}

Agent::Agent(const AgentConfig& config, std::unique_ptr<Planner> planner, std::shared_ptr<ReadyFrames> frames)
    : impl_(std::make_unique<Impl>(config, std::move(planner), std::move(frames))) {}

Agent::~Agent() = default;
Agent::Agent(Agent&&) noexcept = default;
Agent& Agent::operator=(Agent&&) noexcept = default;

void Agent::time_parts(WorkParts::Clock clock) { impl_->parts = std::make_unique<WorkParts>(std::move(clock)); }

const WorkParts* Agent::parts() const { return impl_->parts.get(); }

bool Agent::wants_scans() const { return impl_->planner->wants_scans(); }
bool Agent::wants_beams() const { return impl_->beam_reader.has_value(); }
std::uint64_t Agent::beam_scans(ScanDoubt doubt) const {
  return impl_->beam_reader ? impl_->beam_reader->scans(doubt) : 0;
}
std::vector<std::string> Agent::debug_names() const { return impl_->planner->debug_names(); }

void Agent::Impl::take_in(const AgentInput& input) {
  perceive(input);
  PlannerInput& in = taken_in.emplace(planner_input(input));
  if (!core) return;
  const PartTimer timer(parts.get(), "flight/update");
  core->update(in);
  in.flight = core->state();
  in.space = &space.emplace(core->space(in));
}

void Agent::look(const AgentInput& input) {
  impl_->take_in(input);
  impl_->planner->learner()->look(*impl_->taken_in);
}

AgentOutput Agent::step(const AgentInput& input) {
  if (!impl_->taken_in) impl_->take_in(input);
  const PlannerInput& in = *impl_->taken_in;
  PlannerOutput decision = impl_->plan(in);
  if (!impl_->core) impl_->note_motion(decision.motion);
  if (impl_->core) impl_->fly(in, decision);
  for (const std::string& bytes : decision.heard_maps) impl_->map.hear(bytes);
  if (!decision.no_way.empty()) ++impl_->no_ways[decision.no_way];
  impl_->no_way = std::move(decision.no_way);
  if (decision.waits_for) impl_->wait_for(*decision.waits_for, seconds(input.tick));
  AgentOutput output;
  output.trajectory = impl_->move(decision, input);
  output.gimbal = impl_->point_camera(decision.gimbal, input.state);
  output.trigger = decision.trigger;
  output.radio = std::move(decision.radio);
  if (auto told = impl_->tell_map(decision.going_to_W, input.tick)) output.radio.push_back(std::move(*told));
  output.debug = std::move(decision.debug);
  output.activity = impl_->activity.step(impl_->facts(in, decision.waits_for));
  output.captures = impl_->uplink.send(input.k, impl_->peers.station_visible());
  impl_->taken_in.reset();
  return output;
}

bool Agent::holds_capture(std::uint64_t capture) const { return impl_->uplink.holds(capture); }

std::size_t Agent::undelivered() const { return impl_->uplink.undelivered(); }

const SafetyFilter::Counts* Agent::filter_counts() const {
  return impl_->core ? &impl_->core->filter().counts() : nullptr;
}

const OccupancyMap& Agent::map() const { return impl_->map; }

const WorldMap* Agent::world_map() const { return impl_->known_world(); }

const std::map<std::string, std::uint64_t>& Agent::no_ways() const { return impl_->no_ways; }

const std::string& Agent::no_way() const { return impl_->no_way; }

double Agent::waited_s() const { return impl_->waited_s; }

const std::vector<WaitSpan>& Agent::waits() const { return impl_->waits; }

}  // namespace skein::agent
