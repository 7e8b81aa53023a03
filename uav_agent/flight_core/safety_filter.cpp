#include "uav_agent/flight_core/safety_filter.hpp"

#include <algorithm>
#include <cmath>

#include "uav_agent/flight/site.hpp"

namespace skein::agent {
namespace {

constexpr double kSampleM = 0.3;       ///< between two checked places of a trajectory; chosen
constexpr double kNearerM = 1e-6;      ///< allows for rounding in comparisons of distances
constexpr double kHeightSigmas = 2.0;  ///< a UAV on the ground may be reported higher by this many deviations; chosen
constexpr double kNoiseSigmas = 4.0;   ///< changes within this many standard deviations of noise are not motion; chosen
/// A climb is commanded from a place that noise has shifted, so each step leads a little to the side: by a share of the
/// shift, within this. Chosen.
constexpr double kCommandNoise = 0.1;  ///< [standard deviations of the noise]
/// Time in which a peer flies on before it brakes. Formula: an exchange, and as long until the command takes effect.
constexpr double kPeerDelayS = 0.1;
/// Assumed deceleration of a peer. Chosen: an explorer plans 2.24 m/s^2, its vehicle's limit times the shares in
/// tracker.cpp.
constexpr double kPeerBrakesMps2 = 2.0;
/// Commanded setpoints are means over this time, so braking sets in gradually.
constexpr double kPeerSmoothS = Tracker::Config().smoothing_s;
/// A UAV that is told to brake may still accelerate for this time: commands lag, and the UAV lags behind its commands.
/// Formula: a mean lags by half of its time.
constexpr double kPeerLagS = kPeerDelayS + 0.5 * kPeerSmoothS;
/// A UAV may brake this much later than its commands say, and may fly faster than they say, because controllers
/// overshoot. Without this allowance, two UAVs that speed up towards each other in the same exchange would both use up
/// the same room. Chosen in drawn encounters with bodies that follow 0.2 and 0.25 s late (docs/flight-safety.md).
constexpr double kOwnLagS = 0.2;
constexpr double kRestsMps = 0.2;   ///< a UAV that is not faster is at rest; chosen
constexpr double kFarM = 40.0;      ///< UAVs whose reach is farther away are not considered; chosen
constexpr double kClimbsMps = 1.0;  ///< speed for which clear_up_to() checks a climb; chosen
/// A UAV that went out of sight while it turned or accelerated comes to rest beside the place predicted from its last
/// known state, because its reported velocity lags by half of kPeerSmoothS. Measured over random flights: up to 0.48 m.
constexpr double kUnheardM = 0.5;
constexpr double kAboveStartM = 30.0;  ///< up to this height, space above the start is assumed to be free; chosen
constexpr double kOutOfBoxM = 0.2;     ///< a UAV this far beyond what the filter demands is out of a box; chosen
constexpr double kOnGroundM = 0.25;    ///< a slow UAV whose centre is no higher above its start stands; chosen
/// If the planned speed and the present one are not safe, the filter tries this speed. Chosen.
double slower_mps(double speed_mps) { return 0.9 * speed_mps - 0.02; }

/// Vector to p from the nearest point of a segment.
Vector3d from_segment(const Vector3d& p_W, const Vector3d& a_W, const Vector3d& b_W) {
  const Vector3d ab = b_W - a_W;
  const double length2 = ab.squaredNorm();
  const double part = length2 > 0.0 ? std::clamp((p_W - a_W).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return p_W - (a_W + part * ab);
}

/// Bound of an error in a direction, from its bounds along the axes [m].
double along_m(const Vector3d& error_m, const Vector3d& direction_W) {
  return error_m.cwiseProduct(direction_W.normalized()).norm();
}

/// Distance by which the sides of a box would have to move outwards for it to contain p [m]; negative inside.
double off_box_m(const OrientedBox& box, const Vector3d& p_W) {
  return ((box.R_WO.transpose() * (p_W - box.center)).cwiseAbs() - 0.5 * box.size).maxCoeff();
}

/// Stopping distance of a peer at a speed [m].
double stopping_m(double v_mps) {
  return v_mps * (kPeerDelayS + 0.5 * kPeerSmoothS) + v_mps * v_mps / (2.0 * kPeerBrakesMps2);
}

std::vector<Vector3d> thinned(const std::vector<Vector3d>& way_W) {
  std::vector<Vector3d> places = {way_W.front()};
  for (std::size_t i = 1; i + 1 < way_W.size(); ++i) {
    if ((way_W[i + 1] - places.back()).norm() > kSampleM) places.push_back(way_W[i]);
  }
  if (way_W.size() > 1) places.push_back(way_W.back());
  return places;
}

}  // namespace

SafetyFilter::SafetyFilter(const FlightConfig& config, const AgentConfig& agent)
    : config_(config), agent_(agent), assumes_boxes_(!agent.first_explorer()), nearer_m_(kNearerM) {}

double SafetyFilter::tracking_error_m(Role role, double speed_mps) const {
  return (role == Role::explorer ? config_.error_m : config_.light_error_m) + config_.error_per_mps_s * speed_mps;
}

double SafetyFilter::tube_m(double speed_mps, double halo_m) const {
  const bool sees = agent_.me().role == Role::explorer;
  return agent_.me().body_radius_m + halo_m + tracking_error_m(agent_.me().role, speed_mps) +
         (sees ? errors_.seen_m : errors_.told_m);
}

double SafetyFilter::tube_of_told_m(std::size_t uav) const {
  return tube_m(0.0) - agent_.me().body_radius_m + agent_.fleet[uav].body_radius_m + (errors_.told_m - errors_.seen_m);
}

double SafetyFilter::apart_if_exact_m(std::size_t uav, double speed_mps) const {
  const FleetMember& other = agent_.fleet[uav];
  return agent_.me().body_radius_m + other.body_radius_m + tracking_error_m(agent_.me().role, speed_mps) +
         tracking_error_m(other.role, 0.0) + config_.peer_margin_m;
}

Vector3d SafetyFilter::error_of_m(std::size_t uav) const {
  return uav < errors_.peers_m.size() ? errors_.peers_m[uav] : Vector3d::Zero();
}

double SafetyFilter::apart_m(std::size_t uav, double speed_mps, const Vector3d& direction_W) const {
  return apart_if_exact_m(uav, speed_mps) + along_m(error_of_m(uav), direction_W);
}

double SafetyFilter::apart_m(std::size_t uav, double speed_mps) const {
  return apart_if_exact_m(uav, speed_mps) + error_of_m(uav).maxCoeff();
}

std::optional<TrajectoryCommand> SafetyFilter::step(Tracker& tracker, const Facts& facts, double most_mps,
                                                    bool retraces) {
  held_ = {};
  // With a setpoint below the ground, a UAV stands on it.
  const bool flies = tracker.moves() && tracker.tracking().airborne && tracker.commanded().p_WB.z() > 0.0;
  now_W_ = flies ? tracker.commanded().p_WB : facts.state.p_WB;
  nearer_m_ = std::max(kNearerM, (flies ? kCommandNoise : kNoiseSigmas) * agent_.odometry.noise_sigma_m);
  const double dt_s = agent_.exchange_period_s;
  if (!tracker.moves()) return tracker.step(facts.state, dt_s);
  ++counts_.exchanges;
  const bool room = has_room(facts);
  if (!room) ++counts_.broken;
  // A UAV is put down in free space, though perhaps close beside structure: room there does not mean room to climb.
  const bool leaves_start = now_W_.z() < config_.floor_m && is_above_start(now_W_, agent_.me().p_WB_start);
  had_room_ = had_room_ || (room && !leaves_start);
  halo_m_ = had_room_ ? kHaloM : config_.tight_halo_m;
  if (!had_room_) most_mps = std::min(most_mps, config_.tight_mps);
  const std::vector<PeerReach> peers = reach_of_peers(facts);
  if (auto command = move_on(tracker, facts, most_mps, peers)) return command;
  if (retraces && had_room_ && tracker.tracking().setpoint.v_WB.norm() <= config_.tight_mps) {
    halo_m_ = config_.tight_halo_m;
    if (auto command = move_on(tracker, facts, std::min(most_mps, config_.tight_mps), peers)) return command;
  }
  ++counts_.slowed;
  tracker.limit_speed(0.0);
  return tracker.step(facts.state, dt_s);
}

/// Moves the UAV on as fast as is safe. @returns nullopt if it must brake.
std::optional<TrajectoryCommand> SafetyFilter::move_on(Tracker& tracker, const Facts& facts, double most_mps,
                                                       const std::vector<PeerReach>& peers) {
  const double dt_s = agent_.exchange_period_s;
  const double speed_mps = tracker.tracking().setpoint.v_WB.norm();
  const double limits_mps[] = {most_mps, std::min(most_mps, speed_mps), slower_mps(speed_mps)};
  for (const double limit_mps : limits_mps) {
    if (limit_mps <= 0.0) continue;
    Tracker tried = tracker;
    tried.limit_speed(limit_mps);
    auto command = tried.step(facts.state, dt_s);
    // The commanded setpoint is a mean: until it has caught up with the point mass, it accelerates even if that brakes.
    const double fastest_mps = std::max(tried.commanded().v_WB.norm(), tried.tracking().setpoint.v_WB.norm());
    const Held held = judge(tried.stopping_places(dt_s), fastest_mps, facts, peers);
    if (held.by == Held::By::nothing) {
      tracker = std::move(tried);
      return command;
    }
    if (held_.by == Held::By::nothing) held_ = held;
  }
  return std::nullopt;
}

/// Whether all space around the commanded position that the invariant needs for a UAV at rest is proved free.
bool SafetyFilter::has_room(const Facts& facts) const { return assumes_boxes_ || proved_free(now_W_, facts.map); }

/// The part of an acceleration, computed from two velocities, that their noise does not explain.
Vector3d SafetyFilter::certain_W(const Vector3d& a_W) const {
  const double change_mps = a_W.norm() * agent_.exchange_period_s;
  const double noise_mps = kNoiseSigmas * std::sqrt(2.0) * agent_.odometry.velocity_sigma_mps;
  if (noise_mps == 0.0) return a_W;
  return change_mps > noise_mps ? Vector3d(a_W * (1.0 - noise_mps / change_mps)) : Vector3d::Zero();
}

/// Whether a peer stands on the ground: it is reported slow, and no higher than the errors of two heights explain.
bool SafetyFilter::stands(const Peer& peer) const {
  const double error_m = std::max(kOnGroundM, kHeightSigmas * std::sqrt(2.0) * peer.deviation_m.z());
  const double slow_mps = kRestsMps + kNoiseSigmas * agent_.odometry.velocity_sigma_mps;
  return peer.v_W.norm() < slow_mps && peer.p_W.z() < agent_.fleet[peer.uav].p_WB_start.z() + error_m;
}

/// Whether a peer is at its start, as far as this UAV has seen.
bool SafetyFilter::is_at_start(const Peer& peer) const {
  return !peer.left_start && (peer.p_W - agent_.fleet[peer.uav].p_WB_start).norm() < kBesideStartM;
}

std::vector<SafetyFilter::PeerReach> SafetyFilter::reach_of_peers(const Facts& facts) const {
  std::vector<PeerReach> reach;
  for (const Peer& peer : facts.peers.all()) {
    if (!peer.seen) continue;
    const double age_s = peer.visible ? 0.0 : seconds(facts.tick - *peer.seen);
    if (age_s > config_.peer_memory_s) continue;
    Vector3d p_W = peer.p_W, v_W = peer.v_W;
    // Beside a standing peer, a climb past the height that the peer reports must not count as coming nearer to it.
    const bool on_ground = stands(peer);
    if (on_ground) p_W.z() = std::min({p_W.z(), agent_.fleet[peer.uav].p_WB_start.z(), now_W_.z()});
    if (trust_ == Trust::start && (on_ground || is_at_start(peer))) p_W.z() = now_W_.z();
    const Vector3d soon_W = peer.v_W + kPeerLagS * certain_W(peer.a_W);
    if (peer.visible && soon_W.norm() > v_W.norm()) v_W = soon_W;
    const double speed_mps = v_W.norm();
    Vector3d to_W = p_W;
    // A moving peer may have braked or flown on since its state was received. A peer at rest does not move before its
    // next state is received.
    if (!on_ground && speed_mps > std::max(kRestsMps, kNoiseSigmas * agent_.odometry.velocity_sigma_mps))
      to_W += v_W * (stopping_m(speed_mps) / speed_mps);
    const double apart_m = apart_if_exact_m(peer.uav, facts.state.v_WB.norm()) + (peer.visible ? 0.0 : kUnheardM);
    const double now_m = from_segment(now_W_, p_W, to_W).norm();
    if (now_m > kFarM) continue;
    reach.push_back({peer.uav, p_W, to_W, apart_m, error_of_m(peer.uav), now_m, (now_W_ - p_W).norm()});
  }
  return reach;
}

/// Checks a braking trajectory. What breaks the invariant counts only if the UAV comes nearer to it.
/// @returns the first violation; By::nothing: the trajectory is safe.
Held SafetyFilter::judge(const std::vector<Vector3d>& way_W, double speed_mps, const Facts& facts,
                         const std::vector<PeerReach>& peers) {
  const std::vector<Vector3d> places_W = thinned(way_W);
  const bool exact = trust_ == Trust::all;
  const FleetMember& me = agent_.me();
  const double radius_m = exact ? me.body_radius_m + config_.tight_halo_m + tracking_error_m(me.role, speed_mps)
                                : tube_m(speed_mps, halo_m_);
  for (const Vector3d& p_W : places_W) {
    for (const PeerReach& peer : peers) {
      const Vector3d off_W = from_segment(p_W, peer.from_W, peer.to_W);
      const double off_m = off_W.norm();
      // A UAV that is held above another one would fall onto it: then tight_halo_m replaces peer_margin_m, too.
      const double more_m =
          exact ? std::min(0.0, config_.tight_halo_m - config_.peer_margin_m) : along_m(peer.error_m, off_W);
      if (off_m >= peer.apart_m + kOwnLagS * speed_mps + more_m) continue;
      // If the peer's segment reaches this UAV, no place is nearer to it. So the peer's own position counts, too.
      const bool nearer = off_m < peer.now_m - nearer_m_ || (p_W - peer.from_W).norm() < peer.from_m - nearer_m_;
      if (nearer) return {Held::By::peer, p_W, peer.uav};
    }
    Held held{.at_W = p_W};
    if (!proved(p_W, radius_m, facts, held)) return held;
  }
  return {};
}

bool SafetyFilter::proved(const Vector3d& p_W, double radius_m, const Facts& facts, Held& held) {
  if (facts.map.ball_free(p_W, radius_m, ground_m())) return true;
  cubes_.clear();
  facts.map.not_free_near(p_W, radius_m, ground_m(), cubes_);
  if (assumes_boxes_ && assumed(p_W, radius_m, facts.map, facts.boxes)) return true;
  for (const Cube& cube : cubes_) {
    if (trust_ != Trust::proved && facts.map.known(cube).space != Space::occupied) continue;
    if (facts.map.distance_to_m(cube, p_W) >= facts.map.distance_to_m(cube, now_W_) - nearer_m_) continue;
    held.by = facts.map.known(cube).space == Space::occupied ? Held::By::structure : Held::By::unproved;
    return false;
  }
  return true;
}

Held SafetyFilter::would_hold(const std::vector<Vector3d>& corners_W, const Facts& facts) {
  now_W_ = facts.state.p_WB;
  nearer_m_ = std::max(kNearerM, kNoiseSigmas * agent_.odometry.noise_sigma_m);
  halo_m_ = had_room_ ? kHaloM : config_.tight_halo_m;
  std::vector<Vector3d> way_W;
  Vector3d from_W = now_W_;
  for (const Vector3d& to_W : corners_W) {
    const int steps = static_cast<int>(std::ceil((to_W - from_W).norm() / kSampleM));
    for (int i = 1; i <= steps; ++i) way_W.emplace_back(from_W + (to_W - from_W) * i / steps);
    from_W = to_W;
  }
  return way_W.empty() ? Held{} : judge(way_W, kClimbsMps, facts, reach_of_peers(facts));
}

bool SafetyFilter::clear_up_to(double height_m, const Facts& facts) {
  const Vector3d& p_W = facts.state.p_WB;
  held_ = would_hold({{p_W.x(), p_W.y(), std::max(height_m, p_W.z())}}, facts);
  return held_.by == Held::By::nothing;
}

bool SafetyFilter::proved(const Vector3d& p_W, const WorldMap& map, const std::vector<OrientedBox>& boxes) const {
  return assumes_boxes_ ? assumed(p_W, tube_m(0.0), map, boxes) : proved_free(p_W, map);
}

bool SafetyFilter::proved_free(const Vector3d& p_W, const WorldMap& map) const {
  return map.ball_free(p_W, tube_m(0.0), ground_m());
}

/// A UAV starts in a box if the box is within the room that it needs at its start (halo_m_), above it.
std::optional<Vector3d> SafetyFilter::way_out_W(const std::vector<OrientedBox>& boxes) const {
  if (!assumes_boxes_) return std::nullopt;
  Vector3d p_W = agent_.me().p_WB_start + Vector3d(0.0, 0.0, tube_m(0.0, config_.tight_halo_m));
  const std::optional<double> out_m = way_out_m(boxes, p_W, tube_m(config_.alone_mps) + kOutOfBoxM);
  if (!out_m) return std::nullopt;
  p_W.z() = *out_m;
  return p_W;
}

bool SafetyFilter::assumed(const Vector3d& p_W, double radius_m, const WorldMap& map,
                           const std::vector<OrientedBox>& boxes) const {
  const bool above_start = is_above_start(p_W, agent_.me().p_WB_start) && p_W.z() < kAboveStartM;
  const double room_m = above_start ? 0.5 * radius_m : radius_m;
  if (map.structure_distance_m(p_W) < room_m) return false;
  const std::optional<Vector3d> out_W = way_out_W(boxes);
  if (out_W && is_above_start(p_W, *out_W) && p_W.z() <= out_W->z()) return true;
  return std::ranges::none_of(boxes, [&](const OrientedBox& box) {
    // A UAV that was put down in a box, or below one, has no other way out than straight up.
    const bool about_start = above_start && box.contains(agent_.me().p_WB_start, radius_m);
    return !about_start && off_box_m(box, p_W) <= room_m && off_box_m(box, p_W) < off_box_m(box, now_W_) - nearer_m_;
  });
}

}  // namespace skein::agent
