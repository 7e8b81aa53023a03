// The other UAVs of the fleet, as this UAV knows them: position and velocity while in line of sight.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "core/messages/uav_status.hpp"
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
  bool left_start = false;          ///< was seen to leave its start; false if the scenario's odometry is exact
  /// Standard deviation of p_W's error, per axis, as far as the scenario's conditions tell; 0: exact.
  Vector3d deviation_m = Vector3d::Zero();
  /// Radio link to it in this exchange; nullopt: it is not in line of sight, or the scenario has no path loss.
  std::optional<LinkQuality> link = {};
  bool v_told = false;  ///< v_W is what the UAV reported when it was last seen (Neighbour::v_W)
};

/// Usual standard deviation of a UAV's position in flight, along each axis [m]; larger while the fix is lost.
Vector3d deviation_in_flight_m(const OdometryConditions& odometry);
/// Standard deviation of another UAV's position relative to this UAV's, along each axis [m].
Vector3d relative_deviation_m(const PoseUncertainty& own, const Peer& peer);

class Peers {
 public:
  explicit Peers(const AgentConfig& config);

  /// Takes over the neighbours of this exchange, and the quality of the links to them. Call it once per exchange; nodes
  /// outside the fleet are ignored.
  void update(Tick tick, const std::vector<Neighbour>& neighbours, const LinkQualities& links = {});

  /// All other UAVs, in fleet order.
  const std::vector<Peer>& all() const { return peers_; }
  /// The other UAV with this index in the fleet; nullptr: there is none, or it is this UAV itself.
  const Peer* find(std::size_t uav) const;
  /// Whether the ground station was in line of sight in the last update().
  bool station_visible() const { return station_visible_; }
  /// Radio link to the ground station in the last update(); nullopt as for Peer::link.
  const std::optional<LinkQuality>& station_link() const { return station_link_; }

 private:
  struct Start {
    Vector3d p_W = Vector3d::Zero();
    std::optional<Tick> stood = {};  ///< when its UAV was last seen standing there; nullopt: never
    bool left = false;               ///< whether its UAV was seen to leave it
  };
  double grown(const Start& start, Tick tick) const;
  /// Index of a UAV in peers_; nullopt: it is not there.
  std::optional<std::size_t> place_of(std::size_t uav) const;

  const OdometryConditions odometry_;
  std::vector<Peer> peers_;
  std::vector<Start> starts_;  ///< of the UAVs in peers_, in the same order
  bool station_visible_ = false;
  std::optional<LinkQuality> station_link_;
};

}  // namespace skein::agent
