// Who was seen when and where: the other UAVs as far as line of sight tells.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/messages.hpp"

namespace skein::agent {

struct Peer {
  UavIndex uav = {};
  Vector3d p_W = Vector3d::Zero();  ///< when last seen; the nominal start before
  Vector3d v_W = Vector3d::Zero();  ///< as told, or from sightings at most 0.25 s apart; else zero
  Vector3d a_W = Vector3d::Zero();  ///< how v_W changed between sightings at most 0.25 s apart; else zero
  std::optional<Tick> seen;         ///< nullopt: never
  bool visible = false;             ///< in line of sight at this step
};

class Peers {
 public:
  explicit Peers(const AgentConfig& config);

  /// Takes this step's sightings. Neighbours that are not of the fleet are ignored.
  void update(Tick tick, const std::vector<Neighbour>& neighbours);

  /// All other UAVs, in fleet order.
  const std::vector<Peer>& all() const { return peers_; }
  bool station_visible() const { return station_visible_; }

 private:
  std::vector<Peer> peers_;
  bool station_visible_ = false;
};

}  // namespace skein::agent
