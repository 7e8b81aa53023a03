// Keeps drops of rain and grains of dust out of the world map. A map never forgets what a beam met, so a single false
// return would close the space around it for the whole flight. Drops return single beams at random places, most of them
// close to the LiDAR; a structure returns the beams of scan after scan, and the nearer it is, the more of them. So a
// return in a cube that is not occupied is kept only once the cube has had a number of returns within kConfirmedWithinS
// that drops are very unlikely to cause: 2 at 6 m and beyond, up to 8 close by. Until then the cube stays unknown or
// free. Then it becomes occupied, but in doubt (WorldMap::doubt()), until nearly as many further returns end in it, or
// beams that pass it prove it free.
// Measured: with 60 drops a second at a mean distance of 4 m (preset `harsh`), some 5 of 18,000 drops are
// taken for structure in five minutes, most of them beyond 3 m, before passing beams free those cubes again (test).
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <vector>

#include "uav_agent/maps/block_table.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class ClutterFilter {
 public:
  /// Removes the points that are not confirmed.
  /// @param scan_s  time of the scan   @param p_WL  where the LiDAR was   @param hits_W  points at which beams ended
  void keep_confirmed(double scan_s, const Vector3d& p_WL, const WorldMap& map, std::vector<Eigen::Vector3f>& hits_W);
  /// Doubts the newly occupied cubes. Call it after these points were entered into the map.
  void doubt_new(WorldMap& map);

 private:
  /// Formula: a quarter of the period of the LiDAR's servo, which is one pass over a place.
  static constexpr double kConfirmedWithinS = 2.0;
  static constexpr double kNever = -1e9;  ///< numeric: before any scan
  struct Returns {
    double since_s = kNever;  ///< time of the first one
    int count = 0;            ///< within kConfirmedWithinS since then
  };
  bool confirmed(double scan_s, double range_m, bool in_doubt, const WorldMap::Cube& cube);

  BlockTable<Returns> returns_;  ///< by smallest cube that is not occupied, or in doubt
  std::size_t cubes_ = 0;        ///< in returns_
  std::vector<WorldMap::Cube> new_;
};

}  // namespace skein::agent
