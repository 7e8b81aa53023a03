// Builds a WorldMap from the scans of this UAV's LiDAR.
// Frame: W world.   Units: metres.   Threads: one.   Deterministic.
#pragma once

#include "uav_agent/maps/clear_ways.hpp"
#include "uav_agent/maps/clutter_filter.hpp"
#include "uav_agent/maps/scan_bundles.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class WorldMapper {
 public:
  struct Config {
    WorldMap::Config map = {};
    /// The mapper uses one scan in `every`. The default is all: the CPU time allows it, and more scans prove more space
    /// free.
    int every = 1;
    double bundle_rad = ScanBundler::kBundleRad;  ///< size of a bundle of adjacent beams, see ScanBundler
    /// Radius of the ball around the LiDAR that counts as free at the start. It is greater than the LiDAR's
    /// `range_min_m`, because a beam without a return proves space free only if its first `range_min_m` are known to be
    /// free already (decision 25). Chosen.
    double start_clear_m = 1.2;
    bool clutter = false;  ///< whether to filter returns from rain or dust (ClutterFilter)
  };

  /// @param lidar   `no_return_p` and the share of `dropped_sectors` determine the map's `criterion.no_return_p`.
  /// @param config  its `map.criterion.no_return_p` is ignored.
  WorldMapper(const LidarConfig& lidar, const Config& config);

  /// Enters a scan into the map. Call it with all scans of the LiDAR, in order. It ignores a scan whose beams are
  /// all unknown (ScanDoubt), and a scan whose tick is not a multiple of `every` scan periods. Before it enters the
  /// first scan that it does not ignore, it marks the ball of `start_clear_m` around the LiDAR as free.
  void insert(const BeamScan& scan);

  const WorldMap& map() const { return map_; }
  WorldMap& map() { return map_; }

 private:
  Config config_;
  Tick period_;
  WorldMap map_;
  ScanBundler bundler_;
  RepeatedScans repeated_;
  ClearWays clear_ways_;
  ClutterFilter clutter_;
  std::vector<Eigen::Vector3f> hits_W_;  ///< hits of the present scan without clutter; a member to reuse its memory
  bool started_ = false;
};

}  // namespace skein::agent
