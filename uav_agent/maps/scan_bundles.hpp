// The beams of a scan for a map: bundles of some that leave beside each other, and where beams ended.
// Frames: W world, L LiDAR.   Units: metres.   Threads: one.
#pragma once

#include <functional>
#include <vector>

#include "core/scenario.hpp"
#include "uav_agent/api/beam_scan.hpp"
#include "uav_agent/maps/map_level.hpp"
#include "uav_agent/maps/repeated_scans.hpp"

namespace skein::agent {

/// Whether all that lies within a radius of a segment is known to be free.
using TubeFree = std::function<bool(const Vector3d& a_W, const Vector3d& b_W, double radius_m)>;

/// How far along a unit vector there is no cube that is known to be occupied: `reach_m` at most.
using ClearWay = std::function<double(const Vector3d& from_W, const Vector3d& direction_W, double reach_m)>;

class ScanBundler {
 public:
  /// Beams of a bundle: about 4 degrees each way, which is the smallest cube 8 m away (world_map.hpp). 4 by 2 of a
  /// VLP-16.
  static constexpr double kBundleRad = 0.07;
  /// So many bundles about one must be free for `around_free_m`, to all sides: at 8 m, a cube of 1 m.
  static constexpr int kAround = 2;

  /// @param bundle_rad  0: each beam for itself.
  explicit ScanBundler(const LidarConfig& lidar, double bundle_rad = kBundleRad);

  struct Bundles {
    std::vector<BeamBundle> bundles;
    std::vector<Eigen::Vector3f> hits_W;
  };

  /// All that the scan says. A beam without a return is free as far as the LiDAR reaches, but only where its first
  /// `range_min_m` are known to be free already: the LiDAR is blind there, and what stands there may have swallowed it.
  /// Beams that returned prove theirs themselves. One that met a UAV is free up to there and hit nothing. A bundle is
  /// free as far as all of its beams are.
  ///
  /// The first proof: a UAV is put down where the space about it is clear, farther than its LiDAR is blind, and whoever
  /// keeps the map says so (WorldMap::set_free()). From there on each new place has been proved from the ones before.
  /// @param near_free  asked about the first `range_min_m` of beams without return.
  /// @param clear_way  of a LiDAR that loses returns: a beam without one may have met something, so it is taken for
  ///                   free up to the first cube that is occupied. A surface is: the other beams that meet it return.
  ///                   Empty: no return is lost.
  /// @returns          good until the next call.
  const Bundles& bundle(const BeamScan& scan, const RepeatedScans::Repeated& repeated, const TubeFree& near_free,
                        const ClearWay& clear_way = {});

  /// From a bundle's middle to its farthest beam.
  double half_rad() const { return half_rad_; }

 private:
  /// Which beams make a bundle: rectangles of columns and rings. Those at the edges may be smaller.
  struct Grid {
    std::vector<int> column_edges, ring_edges;  ///< where each begins, and where the last one ends
    std::vector<Vector3d> middles_L;            ///< level by level

    Grid(const LidarConfig& lidar, int columns, int rings, int column_shift, int ring_shift);
    int across() const { return static_cast<int>(column_edges.size()) - 1; }
    int up() const { return static_cast<int>(ring_edges.size()) - 1; }
    std::size_t number(int level, int side) const { return static_cast<std::size_t>(level * across() + side); }
  };

  /// Each scan has another one. With the same, the middles of a LiDAR's bundles would leave along the same lines scan
  /// by scan, and some windows would always be passed by fewer than others.
  const Grid& grid_of(Tick tick) const;
  void find_free(const BeamScan& scan, const Grid& grid, const TubeFree& near_free, const ClearWay& clear_way);
  void look_around(const Grid& grid);

  LidarConfig lidar_;
  int columns_ = 1, rings_ = 1;  ///< of beams, in a bundle
  double half_rad_ = 0.0;
  std::vector<Grid> grids_;
  std::vector<Eigen::Vector3f> directions_L_;   ///< of beams, ring by ring
  std::vector<float> free_m_, around_m_, row_;  ///< by bundle
  Bundles bundles_;
};

}  // namespace skein::agent
