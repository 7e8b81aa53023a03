#include "uav_agent/api/peers.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kMaxGapS = 0.25;      ///< two sightings further apart give no velocity
constexpr double kVelocityGain = 0.5;  ///< of the newest difference; smooths the 20 Hz positions

}  // namespace

Peers::Peers(const AgentConfig& config) {
  for (const UavIndex uav : FirstUavs(config.fleet.size())) {
    if (uav == config.self) continue;
    Peer peer;
    peer.uav = uav;
    peer.p_W = config.fleet[uav].p_WB_start;
    peers_.push_back(peer);
  }
}

void Peers::update(Tick tick, const std::vector<Neighbour>& neighbours) {
  station_visible_ = false;
  for (Peer& peer : peers_) peer.visible = false;
  for (const Neighbour& neighbour : neighbours) {
    if (neighbour.node == kStationNode) {
      station_visible_ = true;
      continue;
    }
    const UavIndex uav = *uav_of_node(neighbour.node);
    const auto found =
        std::ranges::lower_bound(peers_, std::size_t{uav}, {}, [](const Peer& peer) { return std::size_t{peer.uav}; });
    if (found == peers_.end() || found->uav != uav) continue;
    Peer& peer = *found;
    const double gap_s = peer.seen ? seconds(tick - *peer.seen) : kMaxGapS + 1.0;
    const Vector3d v_before_W = peer.v_W;
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
  }
}

}  // namespace skein::agent
