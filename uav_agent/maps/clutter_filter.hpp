// Keeps drops of rain and grains of dust out of the world map. A map never forgets what a beam met, so a single false
// return would close the space around it for the whole flight. Drops return single beams at random places, a structure
// returns the beams of scan after scan. So a return in a cube that is not occupied is kept only if the cube has had
// another return within kConfirmedWithinS; and the cube becomes occupied in doubt (WorldMap::doubt()), until a third
// beam ends in it, or beams that pass it prove it free. Until then the cube is as unknown, or as free, as it was.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <vector>

#include "uav_agent/maps/block_table.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class ClutterFilter {
 public:
  /// Removes the unconfirmed ones of the points at which beams ended. @param scan_s  time of the scan
  void keep_confirmed(double scan_s, const WorldMap& map, std::vector<Eigen::Vector3f>& hits_W);
  /// Call it when these points have been entered.
  void doubt_new(WorldMap& map);

 private:
  static constexpr double kConfirmedWithinS = 2.0;  ///< a servo's period is four times as long: one pass over a place
  static constexpr double kNever = -1e9;
  struct LastReturn {
    double at_s = kNever;
  };

  BlockTable<LastReturn> last_;  ///< by smallest cube that is not occupied
  std::size_t cubes_ = 0;        ///< in last_
  std::vector<WorldMap::Cube> new_;
};

}  // namespace skein::agent
