#include "uav_agent/flight/separation.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kStandingMps = 0.3;
constexpr double kStandsOnS = 20.0, kFliesOnS = 2.0;  ///< so long, who went out of sight is reckoned with
constexpr double kBrakingMps2 = 3.0;
constexpr double kComingNearerM = 0.05;    ///< a distance that does not shrink by this is no approach
constexpr double kPatiencePerRankS = 0.5;  ///< two UAVs that wait for each other do not lose patience together
constexpr double kMovingPatience = 3.0;    ///< times as much with somebody who moves
constexpr double kPlanAroundM = 15.0;      ///< whoever is farther away will be elsewhere when this UAV comes
constexpr double kKeepOutExtraM = 0.3;
constexpr double kPastS = 30.0;          ///< so long, whoever waited in vain for somebody who stands flies past nearer
constexpr double kCrowdM = 6.0;          ///< starts nearer than this wait for each other
constexpr double kClearHeightM = 3.0;    ///< the one before is this far up, or gone: the next may start
constexpr double kStartPatienceS = 4.0;  ///< for each one before; after that it is taken to be broken

/// What somebody moves in a time who brakes from now on: who flies behind another one is told by nobody that it will.
Vector3d braked_way(const Vector3d& v_W, double t) {
  const double speed = v_W.norm(), braking_s = std::min(t, speed / kBrakingMps2);
  return speed > 0.0 ? Vector3d(v_W / speed * (speed * braking_s - 0.5 * kBrakingMps2 * braking_s * braking_s))
                     : Vector3d::Zero();
}

}  // namespace

std::vector<Vector3d> positions_ahead(const Vector3d& from_W, const std::vector<Waypoint>& waypoints, double dt_s,
                                      int count) {
  std::vector<Vector3d> positions = {from_W};
  Vector3d at = from_W;
  std::size_t leg = 0;
  while (static_cast<int>(positions.size()) < count) {
    double time = dt_s;
    while (time > 0.0 && leg < waypoints.size()) {
      const Vector3d to_go = waypoints[leg].p_WB - at;
      const double step = std::max(0.05, waypoints[leg].speed_mps) * time;
      if (step < to_go.norm()) {
        at += to_go.normalized() * step;
        break;
      }
      time -= to_go.norm() / std::max(0.05, waypoints[leg].speed_mps);
      at = waypoints[leg++].p_WB;
    }
    positions.push_back(at);
  }
  return positions;
}

std::vector<Peer> reckoned(const Peers& peers, Tick now) {
  std::vector<Peer> there;
  for (Peer peer : peers.all()) {
    if (!peer.seen) continue;
    const bool stood = peer.v_W.norm() < kStandingMps;
    const double out_of_sight_s = peer.visible ? 0.0 : seconds(now - *peer.seen);
    if (out_of_sight_s > (stood ? kStandsOnS : kFliesOnS)) continue;
    if (!stood) peer.p_W += out_of_sight_s * peer.v_W;
    there.push_back(peer);
  }
  return there;
}

double Separation::contact_m(std::size_t uav) const {
  return agent_.me().body_radius_m + agent_.fleet[uav].body_radius_m;
}

double Separation::margin_m(Tick now) const { return now < past_until_ ? config_.tight_m : config_.margin_m; }

Traffic Separation::judge(Tick now, const std::vector<Vector3d>& ahead, double dt_s, const Peers& peers) {
  hindered_by_.reset();
  bool standing = false;
  for (const Peer& peer : reckoned(peers, now)) {
    const bool stands = peer.v_W.norm() < kStandingMps;
    const bool has_way = stands || peer.uav < agent_.self;
    const double wanted_m = stands ? margin_m(now) : has_way ? config_.margin_m : config_.tight_m;
    const double limit = contact_m(peer.uav) + wanted_m;
    const double brakes_limit = std::min(limit, contact_m(peer.uav) + config_.tight_m);
    const double distance_now = (ahead.front() - peer.p_W).norm();
    for (std::size_t i = 1; i < ahead.size() && static_cast<double>(i) * dt_s <= config_.horizon_s; ++i) {
      const double t = static_cast<double>(i) * dt_s;
      const double on = (ahead[i] - peer.p_W - t * peer.v_W).norm();
      const double braking = (ahead[i] - peer.p_W - braked_way(peer.v_W, t)).norm();
      const bool meets = on < limit && on < distance_now - kComingNearerM;
      const bool runs_into = braking < brakes_limit && braking < distance_now - kComingNearerM;
      if (!meets && !runs_into) continue;
      hindered_by_ = peer.uav;
      standing |= stands;
      break;
    }
  }
  if (!hindered_by_) {
    waiting_since_.reset();
    return Traffic::clear;
  }
  if (!waiting_since_) waiting_since_ = now;
  const double patience = config_.patience_s + kPatiencePerRankS * static_cast<double>(agent_.self);
  if (seconds(now - *waiting_since_) < (standing ? 1.0 : kMovingPatience) * patience) return Traffic::wait;
  waiting_since_ = now;
  if (standing) past_until_ = now + ticks(kPastS);
  return Traffic::go_around;
}

std::vector<Sphere> Separation::keep_out(Tick now, const Vector3d& p_W_now, const Peers& peers) const {
  std::vector<Sphere> spheres;
  for (const Peer& peer : reckoned(peers, now)) {
    const double distance = (peer.p_W - p_W_now).norm();
    if (distance >= kPlanAroundM) continue;
    const double wanted = contact_m(peer.uav) + margin_m(now) + kKeepOutExtraM;
    spheres.push_back({peer.p_W, std::min(wanted, distance - kComingNearerM)});
  }
  return spheres;
}

bool Separation::starts_before(std::size_t uav) const {
  const bool sees = agent_.fleet[uav].role == Role::explorer, i_see = agent_.me().role == Role::explorer;
  return sees != i_see ? sees : uav < agent_.self;
}

std::optional<std::size_t> Separation::lifts_off_after(Tick now, const Peers& peers) {
  if (!ready_since_) ready_since_ = now;
  int before = 0;
  std::optional<std::size_t> stands;
  for (const Peer& peer : peers.all()) {
    const Vector3d start = agent_.fleet[peer.uav].p_WB_start;
    if (!starts_before(peer.uav) || (start - agent_.me().p_WB_start).norm() > kCrowdM) continue;
    ++before;
    if ((peer.p_W - start).norm() < kClearHeightM) stands = peer.uav;
  }
  return seconds(now - *ready_since_) > kStartPatienceS * before ? std::nullopt : stands;
}

}  // namespace skein::agent
