#include "uav_agent/onboard/agent.hpp"

#include <algorithm>
#include <cmath>

#include "core/euler.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/world_mapper.hpp"
#include "uav_agent/onboard/beam_reader.hpp"
#include "uav_agent/onboard/key_frame_filter.hpp"
#include "uav_agent/onboard/ready_frames.hpp"
#include "uav_agent/onboard/tracker.hpp"
#include "uav_agent/onboard/uplink.hpp"
#include "uav_agent/planning/aiming.hpp"

namespace skein::agent {
namespace {

constexpr double kAccelerationShare = 0.7;  ///< of the vehicle's limit; the controller corrects with the rest
constexpr double kBodyMarginM = 0.3;        ///< around a known body
constexpr double kScanAgeS = 0.1;           ///< a scan is at most this much older than the positions with it
constexpr double kWaitBreak_s = 0.5;

Tracker::Config tracker_config(const VehicleConfig& vehicle) {
  Tracker::Config config;
  config.max_speed_mps = vehicle.max_speed_mps;
  config.max_acceleration_mps2 = kAccelerationShare * vehicle.max_acceleration_mps2;
  config.max_yaw_rate = std::min(config.max_yaw_rate, vehicle.max_yaw_rate_deg_s * kRadPerDeg);
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
    const bool maps_world = planner->wants_world_map();
    if (!config.vehicle.lidar) {
      if (maps_world) world_map = std::make_unique<WorldMap>(WorldMap::Config());
      return;
    }
    if (planner->wants_beams() || maps_world) beam_reader.emplace(*config.vehicle.lidar);
    if (maps_world) world_mapper = std::make_unique<WorldMapper>(*config.vehicle.lidar, WorldMapper::Config());
  }

  void read_beams(const AgentInput& input);
  void perceive(const AgentInput& input);
  std::vector<KnownBody> other_bodies() const;
  std::vector<KnownBody> known_bodies(const AgentInput& input) const;
  std::optional<Vector3d> sensor_position(const KeyFrame& frame, const AgentInput& input) const;
  PlannerInput planner_input(const AgentInput& input) const;
  std::optional<TrajectoryCommand> move(const PlannerOutput& decision, const RigidBodyState& state);
  std::optional<GimbalCommand> point_camera(const GimbalAim& new_aim, const RigidBodyState& state);
  void wait_for(std::size_t mate, double now_s);

  const AgentConfig config;
  const std::unique_ptr<Planner> planner;
  const std::shared_ptr<ReadyFrames> frames;
  Peers peers;
  OccupancyMap map;
  std::optional<BeamReader> beam_reader;      ///< if the planner wants beams and there is a LiDAR
  std::vector<BeamScan> beam_scans;           ///< of this exchange
  std::unique_ptr<WorldMapper> world_mapper;  ///< if the planner wants the map and there is a LiDAR
  std::unique_ptr<WorldMap> world_map;        ///< if it wants the map and there is none
  Uplink uplink;
  Tracker tracker;
  std::vector<OrientedBox> boxes;
  GimbalAim aim;
  double waited_s = 0.0;
  std::vector<WaitSpan> waits;
  std::map<std::string, std::uint64_t> no_ways;
  std::string no_way;
};

void Agent::Impl::wait_for(std::size_t mate, double now_s) {
  waited_s += config.exchange_period_s;
  const bool goes_on =
      !waits.empty() && waits.back().mate == mate && now_s < waits.back().until_s + kWaitBreak_s + 1e-6;
  if (!goes_on) waits.push_back({now_s, now_s, mate});
  waits.back().until_s = now_s + config.exchange_period_s;
}

std::vector<KnownBody> Agent::Impl::other_bodies() const {
  std::vector<KnownBody> bodies;
  for (const Peer& peer : peers.all()) {
    // One that was never seen still stands where it was put.
    if (!peer.visible && peer.seen) continue;
    bodies.push_back(known_body(peer.p_W, peer.v_W, config.fleet[peer.uav].body_radius_m));
  }
  return bodies;
}

std::vector<KnownBody> Agent::Impl::known_bodies(const AgentInput& input) const {
  std::vector<KnownBody> bodies = other_bodies();
  bodies.insert(bodies.begin(), known_body(input.state.p_WB, input.state.v_WB, config.me().body_radius_m));
  return bodies;
}

void Agent::Impl::read_beams(const AgentInput& input) {
  beam_scans.clear();
  if (!beam_reader) return;
  beam_reader->hear(input.tick, input.state);
  for (const LidarServo& servo : input.servos) beam_reader->hear(servo);
  if (input.scans.empty()) return;
  const std::vector<KnownBody> others = other_bodies();
  for (const Scan& scan : input.scans) {
    beam_scans.push_back(beam_reader->read(scan, others));
    if (world_mapper) world_mapper->insert(beam_scans.back());
  }
}

void Agent::Impl::perceive(const AgentInput& input) {
  if (tracker.stands_by()) tracker.stand_by(input.state);
  peers.update(input.tick, input.neighbours);
  read_beams(input);
  if (!input.boxes.empty()) boxes = input.boxes;
  if (!input.key_frames.empty()) {
    const KnownBodies bodies(known_bodies(input));
    // A lone hit may be a UAV out of sight; but far off, it is all that a LiDAR finds of a thin member, and where one
    // box holds everything, UAVs fly between members that were only seen from afar.
    const bool keep_lone = std::any_of(boxes.begin(), boxes.end(), is_roomy);
    for (const KeyFrame& frame : input.key_frames) {
      auto sound_W = frames->filter(keep_lone).sound(frame.points_W, bodies);
      const std::optional<Vector3d> p_WS = sensor_position(frame, input);
      const ReadyFrames::Frame& ready = frames->ready(std::move(sound_W), p_WS, keep_lone);
      map.insert(ready.cells);
      if (ready.plane_W) map.look_from(*p_WS, *ready.plane_W);
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
                      .radio = input.radio,
                      .key_frames = input.key_frames,
                      .scans = planner->wants_scans() ? std::span(input.scans) : std::span<const Scan>(),
                      .beam_scans = planner->wants_beams() ? std::span(beam_scans) : std::span<BeamScan>(),
                      .world_map = world_mapper ? &world_mapper->map() : world_map.get()};
}

std::optional<TrajectoryCommand> Agent::Impl::move(const PlannerOutput& decision, const RigidBodyState& state) {
  if (const auto* command = std::get_if<TrajectoryCommand>(&decision.motion)) {
    tracker.stand_by(state);
    return *command;
  }
  if (decision.yaw) tracker.turn_to(*decision.yaw);
  if (const auto* path = std::get_if<Path>(&decision.motion)) tracker.follow(*path);
  if (const auto* setpoint = std::get_if<Setpoint>(&decision.motion)) tracker.fly_to(*setpoint);
  if (std::holds_alternative<Hold>(decision.motion)) tracker.hold();
  return tracker.step(state, config.exchange_period_s);
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

bool Agent::wants_scans() const { return impl_->planner->wants_scans(); }
bool Agent::wants_beams() const { return impl_->beam_reader.has_value(); }
std::uint64_t Agent::beam_scans(ScanDoubt doubt) const {
  return impl_->beam_reader ? impl_->beam_reader->scans(doubt) : 0;
}
std::vector<std::string> Agent::debug_names() const { return impl_->planner->debug_names(); }

AgentOutput Agent::step(const AgentInput& input) {
  impl_->perceive(input);
  PlannerOutput decision = impl_->planner->plan(impl_->planner_input(input));
  for (const std::string& bytes : decision.heard_maps) impl_->map.hear(bytes);
  if (!decision.no_way.empty()) ++impl_->no_ways[decision.no_way];
  impl_->no_way = std::move(decision.no_way);
  if (decision.waits_for) impl_->wait_for(*decision.waits_for, seconds(input.tick));
  AgentOutput output;
  output.trajectory = impl_->move(decision, input.state);
  output.gimbal = impl_->point_camera(decision.gimbal, input.state);
  output.trigger = decision.trigger;
  output.radio = std::move(decision.radio);
  output.debug = std::move(decision.debug);
  output.captures = impl_->uplink.send(input.k, impl_->peers.station_visible());
  return output;
}

bool Agent::holds_capture(std::uint64_t capture) const { return impl_->uplink.holds(capture); }

const OccupancyMap& Agent::map() const { return impl_->map; }

const std::map<std::string, std::uint64_t>& Agent::no_ways() const { return impl_->no_ways; }

const std::string& Agent::no_way() const { return impl_->no_way; }

double Agent::waited_s() const { return impl_->waited_s; }

const std::vector<WaitSpan>& Agent::waits() const { return impl_->waits; }

}  // namespace skein::agent
