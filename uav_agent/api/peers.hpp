// The other UAVs of the fleet, as this UAV knows them: position and velocity while in line of sight.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/messages.hpp"

namespace skein::agent {

struct Peer {
  UavIndex uav = {};
  Vector3d p_W = Vector3d::Zero();  ///< position when last seen; before that, its nominal start
  Vector3d v_W = Vector3d::Zero();  ///< Neighbour::v_W; else from positions at most 0.25 s apart; else zero
  Vector3d a_W = Vector3d::Zero();  ///< change of v_W between two sightings at most 0.25 s apart; else zero
  std::optional<Tick> seen;         ///< when it was last in line of sight; nullopt: never
  bool visible = false;             ///< in line of sight in this exchange
};

class Peers {
 public:
  explicit Peers(const AgentConfig& config);

  /// Takes over the neighbours of this exchange. Call it once per exchange; nodes outside the fleet are ignored.
  void update(Tick tick, const std::vector<Neighbour>& neighbours);

  /// All other UAVs, in fleet order.
  const std::vector<Peer>& all() const { return peers_; }
  /// Whether the ground station was in line of sight in the last update().
  bool station_visible() const { return station_visible_; }

 private:
  std::vector<Peer> peers_;
  bool station_visible_ = false;
};

}  // namespace skein::agent
