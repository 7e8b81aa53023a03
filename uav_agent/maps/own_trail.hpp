// Records the places at which another UAV may have mapped this UAV's own body as structure.
//
// A UAV with a LiDAR that does not hear this UAV maps its body like a wall (uav_traces.hpp), and reports these cubes to
// this UAV as soon as they hear each other again. No beam could prove these cubes free while this UAV stays there, so
// they would hold it there. The map therefore ignores a report of structure in a cube that it has proved free if this
// trail contains the cube (WorldMap::ignore_reports()): space that was proved free, in which this UAV's body was, has
// no structure. The trail contains cubes whose centre is within the radius in which beams may hit the body
// (seen_radius_m()) of one of these places:
//   - the place where this UAV is now;
//   - all places where it was in the last 60 to 120 s while it did not hear all other UAVs that have a LiDAR.
// A report may also mean another UAV whose radio is silent. Therefore the trail is short, and does not contain the
// places where this UAV was linked with all UAVs that have a LiDAR.
// Frame W.   Units: metres, ticks.   Threads: one.   Deterministic.   Source: none; a rule of Skein.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.hpp"
#include "uav_agent/api/peers.hpp"
#include "uav_agent/maps/block_table.hpp"

namespace skein::agent {

class OwnTrail {
 public:
  /// Errors of hits, and motion of the body between its positions. Chosen.
  static constexpr double kMarginM = 0.3;
  static constexpr double kPartS = 60.0;  ///< the trail is forgotten in parts of this length; chosen

  /// @param cell_m  edge of the map's smallest cubes.
  OwnTrail(const AgentConfig& agent, double cell_m);

  /// Call it at each exchange, before its map messages enter the map.
  /// @param p_WB  this UAV's position by its odometry.
  void update(Tick now, const Peers& peers, const Vector3d& p_WB);
  /// @param cube  a smallest cube of the map.
  bool contains(const Eigen::Vector3i& cube) const;

 private:
  using Part = BlockTable<std::uint64_t>;  ///< by block of 4^3 cubes: one bit for each cube

  bool near(const Eigen::Vector3i& cube) const;
  void mark();

  std::vector<std::size_t> lidars_;  ///< the other UAVs that have a LiDAR, by index in the fleet
  double radius_m_, cell_m_;
  Vector3d p_WB_ = Vector3d::Zero();
  Part newer_, older_;
  Tick newer_since_ = 0;
};

}  // namespace skein::agent
