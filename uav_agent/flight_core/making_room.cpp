#include "uav_agent/flight_core/making_room.hpp"

#include <algorithm>

#include "uav_agent/flight_core/place_near.hpp"

namespace skein::agent {
namespace {

constexpr double kCloseM = 0.6;   ///< beyond what the safety filter demands; a UAV that is nearer is too close; chosen
constexpr double kEnoughM = 2.0;  ///< more room than this is not needed; chosen
constexpr double kBetterM = 0.5;  ///< least gain of room that is worth the flight; chosen

}  // namespace

MakingRoom::MakingRoom(const FlightConfig& config, const AgentConfig& agent, SafetyFilter& filter)
    : config_(config), agent_(agent), filter_(filter), others_(agent.fleet.size()) {}

void MakingRoom::note(const Vector3d& p_W, Tick tick, Stand& stand) {
  if ((p_W - stand.p_W).norm() > kStaysM) stand = {p_W, tick};
}

void MakingRoom::update(const PlannerInput& in) {
  note(in.tracking.setpoint.p_WB, in.tick, own_);
  for (const Peer& peer : in.peers.all()) {
    Stand& stand = others_[peer.uav];
    if (!peer.visible) stand.since = in.tick;
    note(peer.p_W, in.tick, stand);
  }
}

/// Least distance from a place to the UAVs in sight, beyond what the safety filter demands; at most kEnoughM [m].
double MakingRoom::room_m(const Vector3d& p_W, const PlannerInput& in) const {
  double room_m = kEnoughM;
  for (const Peer& peer : in.peers.all()) {
    if (peer.visible) room_m = std::min(room_m, room_to_m(peer, p_W));
  }
  return room_m;
}

double MakingRoom::room_to_m(const Peer& peer, const Vector3d& p_W) const {
  return (p_W - peer.p_W).norm() - filter_.apart_m(peer.uav, 0.0, p_W - peer.p_W);
}

std::optional<Vector3d> MakingRoom::place_W(const PlannerInput& in) {
  const Tick patience = ticks(config_.held_s());
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  const bool crowded = std::ranges::any_of(in.peers.all(), [&](const Peer& peer) {
    return peer.visible && in.tick - others_[peer.uav].since > patience && room_to_m(peer, here_W) < kCloseM;
  });
  if (!crowded || in.tick - own_.since <= patience) return std::nullopt;
  own_.since = in.tick;  // if there is no place, try again later
  const SafetyFilter::Facts facts{in.tick, in.state, *in.world_map, in.boxes, in.peers};
  return best_place_near_W(
      here_W, agent_.me().p_WB_start.z() + config_.floor_m, room_m(here_W, in) + kBetterM,
      [&](const Vector3d& p_W) { return room_m(p_W, in); }, filter_, facts);
}

}  // namespace skein::agent
