// Prepares the beams of a scan for a map: bundles of adjacent beams, and the points that beams have hit.
// Frames: W world, L LiDAR.   Units: metres.   Threads: one.
#pragma once

#include <functional>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "uav_agent/api/beam_scan.hpp"
#include "uav_agent/maps/map_level.hpp"
#include "uav_agent/maps/repeated_scans.hpp"

namespace skein::agent {

/// Whether all space within a radius of a segment is known to be free.
using TubeFree = std::function<bool(const Vector3d& a_W, const Vector3d& b_W, double radius_m)>;

/// The distance along a unit vector up to the first cube that is known to be occupied; `reach_m` at most.
using ClearWay = std::function<double(const Vector3d& from_W, const Vector3d& direction_W, double reach_m)>;

class ScanBundler {
 public:
  /// Size of a bundle: about 4 degrees in each direction. Geometry: like the smallest cube at 8 m (world_map.hpp). For
  /// a VLP-16, that is 4 by 2 beams.
  static constexpr double kBundleRad = 0.07;
  /// `around_free_m` is how far a bundle and this many neighbours on each side are free. Geometry: at 8 m, a cube of
  /// 1 m.
  static constexpr int kAround = 2;

  /// @param bundle_rad  0: each beam is a bundle.
  explicit ScanBundler(const LidarConfig& lidar, double bundle_rad = kBundleRad);

  struct Bundles {
    std::vector<BeamBundle> bundles;
    std::vector<Eigen::Vector3f> hits_W;
  };

  /// All evidence of the scan. A beam without a return is free up to the LiDAR's maximum range, but only if its first
  /// `range_min_m` are known to be free already: the LiDAR is blind there, and an object there could block the beam.
  /// A beam with a return proves its first `range_min_m` itself. A beam that met a UAV is free up to the UAV and has no
  /// hit. A bundle is free as far as all of its beams are.
  ///
  /// The first proof: a UAV starts where the space around it is free farther than its LiDAR is blind, and the owner of
  /// the map marks it as free (WorldMap::set_free()). From there on, the space proved so far proves each new place.
  /// @param near_free  asked about the first `range_min_m` of beams without return.
  /// @param clear_way  for a LiDAR that loses returns: a beam without return may have hit something, so it counts as
  ///                   free only up to the first occupied cube. Cubes of a surface are occupied, because other beams
  ///                   that hit it return. Empty: the LiDAR loses no return.
  /// @returns          valid until the next call.
  const Bundles& bundle(const BeamScan& scan, const RepeatedScans::Repeated& repeated, const TubeFree& near_free,
                        const ClearWay& clear_way = {});

  /// Angle from a bundle's middle to its farthest beam.
  double half_rad() const { return half_rad_; }

 private:
  /// Division of the beams into bundles: rectangles of columns and rings. Those at the edges may be smaller.
  struct Grid {
    std::vector<int> column_edges, ring_edges;  ///< first column (ring) of each rectangle; then the end of the last
    std::vector<Vector3d> middles_L;            ///< unit vectors, level by level

    Grid(const LidarConfig& lidar, int columns, int rings, int column_shift, int ring_shift);
    int across() const { return static_cast<int>(column_edges.size()) - 1; }
    int up() const { return static_cast<int>(ring_edges.size()) - 1; }
    std::size_t number(int level, int side) const { return static_cast<std::size_t>(level * across() + side); }
  };

  /// The grid changes from scan to scan. With a fixed grid, the middles of the bundles would lie on the same lines
  /// in every scan, so that fewer bundles would always pass through some windows than through others.
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
