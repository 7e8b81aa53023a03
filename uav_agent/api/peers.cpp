#include "uav_agent/api/peers.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

constexpr double kMaxGapS =
    0.25;  ///< do not compute a velocity from two sightings with a longer time between them; chosen
constexpr double kVelocityGain =
    0.5;  ///< weight of the newest velocity in the running average, which smooths 20 Hz data; chosen
/// A UAV this near to its start, and not faster than kStandsMps, stands there. Chosen.
constexpr double kStandsM = 0.5, kStandsMps = 0.3;

double square(double x) { return x * x; }

/// Standard deviation of a position error, along each axis [m]. @param grown  variance of the drift as a share of its
///   stationary variance, 0 to 1; bias and noise are independent of it.
Vector3d deviation_m(const OdometryConditions& odometry, double grown) {
  const double always2 = square(odometry.bias_sigma_m) + square(odometry.noise_sigma_m);
  const double across_m = std::sqrt(always2 + grown * square(odometry.horizontal_sigma_m));
  return {across_m, across_m, std::sqrt(always2 + grown * square(odometry.vertical_sigma_m))};
}

}  // namespace

Vector3d deviation_in_flight_m(const OdometryConditions& odometry) { return deviation_m(odometry, 1.0); }

Vector3d relative_deviation_m(const PoseUncertainty& own, const Peer& peer) {
  return (own.position_m.cwiseAbs2() + peer.deviation_m.cwiseAbs2()).cwiseSqrt();
}

Peers::Peers(const AgentConfig& config) : odometry_(config.odometry) {
  for (const UavIndex uav : FirstUavs(config.fleet.size())) {
    if (uav == config.self) continue;
    Peer peer;
    peer.uav = uav;
    peer.p_W = config.fleet[uav].p_WB_start;
    peers_.push_back(peer);
    starts_.push_back({peer.p_W});
  }
}

std::optional<std::size_t> Peers::place_of(std::size_t uav) const {
  const auto found = std::ranges::lower_bound(peers_, uav, {}, [](const Peer& peer) { return std::size_t{peer.uav}; });
  if (found == peers_.end() || found->uav != uav) return std::nullopt;
  return static_cast<std::size_t>(found - peers_.begin());
}

const Peer* Peers::find(std::size_t uav) const {
  const std::optional<std::size_t> place = place_of(uav);
  return place ? &peers_[*place] : nullptr;
}

void Peers::update(Tick tick, const std::vector<Neighbour>& neighbours, const LinkQualities& links) {
  station_visible_ = false;
  station_link_.reset();
  for (Peer& peer : peers_) {
    peer.visible = false;
    peer.link.reset();
  }
  for (const Neighbour& neighbour : neighbours) {
    const auto link = std::ranges::find(links, neighbour.node, &LinkQualities::value_type::first);
    const auto quality = link == links.end() ? std::nullopt : std::optional(link->second);
    if (neighbour.node == kStationNode) {
      station_visible_ = true;
      station_link_ = quality;
      continue;
    }
    const std::optional<std::size_t> place = place_of(*uav_of_node(neighbour.node));
    if (!place) continue;
    Peer& peer = peers_[*place];
    const double gap_s = peer.seen ? seconds(tick - *peer.seen) : kMaxGapS + 1.0;
    const Vector3d v_before_W = peer.v_W;
    peer.v_told = neighbour.v_W.has_value();
    if (neighbour.v_W) {
      peer.v_W = *neighbour.v_W;
    } else if (gap_s > kMaxGapS) {
      peer.v_W.setZero();
    } else if (gap_s > 0.0) {
      const Vector3d v_new = (neighbour.p_W - peer.p_W) / gap_s;
      peer.v_W += kVelocityGain * (v_new - peer.v_W);
    }
    const bool goes_on = gap_s > 0.0 && gap_s <= kMaxGapS;
    peer.a_W = goes_on ? Vector3d((peer.v_W - v_before_W) / gap_s) : Vector3d::Zero();
    peer.p_W = neighbour.p_W;
    peer.seen = tick;
    peer.visible = true;
    peer.link = quality;
  }
  if (!odometry_.on()) return;
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    Start& start = starts_[i];
    if (peers_[i].visible && !start.left) {
      start.left = (peers_[i].p_W - start.p_W).norm() > kStandsM || peers_[i].v_W.norm() > kStandsMps;
      if (!start.left) start.stood = tick;
    }
    peers_[i].left_start = start.left;
    peers_[i].deviation_m = deviation_m(odometry_, grown(start, tick));
  }
}

/// Share of its stationary variance that the drift of a UAV's position has reached, 0 to 1. If UAVs know their starts,
/// it grows from when the UAV leaves its start. It ignores losses of the fix, which UAVs do not report to each other.
double Peers::grown(const Start& start, Tick tick) const {
  if (!odometry_.known_start || (start.left && !start.stood)) return 1.0;
  return -std::expm1(-2.0 * seconds(tick - start.stood.value_or(0)) / odometry_.time_constant_s);
}

}  // namespace skein::agent
