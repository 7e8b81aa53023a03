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

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
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
  /// The number of the scan of a cube's first return, in the upper bits, and the number of returns since then. Memory:
  /// 32 bits suffice for 19 days of scans at 10 Hz, and a count never exceeds the 8 returns that confirm a cube.
  using Returns = std::uint32_t;
  static constexpr int kCountBits = 8;                           ///< memory, as above
  static constexpr Returns kNever = 0;                           ///< no return yet
  static constexpr std::array<int, 3> kGroupBits = {2, 2, 1};    ///< memory: a group is flat, as the ground is
  using Group = std::array<Returns, 32>;                         ///< memory: 4 x 4 x 2 cubes, x first: two cache lines
  static constexpr int kNone = std::numeric_limits<int>::max();  ///< numeric
  static inline const WorldMap::Cube kNoCube = WorldMap::Cube::Constant(kNone);

  void begin_scan(double scan_s);
  Returns& returns_in(const WorldMap::Cube& cube);
  /// Notes a return in a cube below the ground. @returns whether to remove it, because the cube is not structure: the
  /// map ignores it, however often beams end in it.
  bool underground(const WorldMap::Cube& cube, const WorldMap& map);
  bool confirmed(double range_m, bool in_doubt, const WorldMap::Cube& cube);

  BlockTable<Group> groups_;               ///< returns in cubes that are not occupied, or in doubt
  WorldMap::Cube group_at_ = kNoCube;      ///< of the last group asked for; valid during a scan
  Group* group_ = nullptr;                 ///< that group
  BlockTable<std::uint64_t> underground_;  ///< cubes below the ground with any return, one bit each
  std::size_t cubes_ = 0;                  ///< with any return
  std::uint32_t scan_ = 0;                 ///< number of the present scan, from 1 on
  std::uint32_t first_recent_ = 1;         ///< number of the first scan of the last kConfirmedWithinS
  std::deque<double> recent_s_;            ///< the times of these scans
  std::vector<WorldMap::Cube> new_;
};

}  // namespace skein::agent
