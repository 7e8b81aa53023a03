// Builds a WorldMap from the scans of this UAV's LiDAR.
// Frames: W world, B body.   Units: metres.   Threads: one.   Deterministic.
#pragma once

#include "uav_agent/maps/clutter_filter.hpp"
#include "uav_agent/maps/scan_bundles.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class WorldMapper {
 public:
  struct Config {
    WorldMap::Config map = {};
    /// Uses one scan in `every`. The default uses all: the CPU time allows it, and more scans prove more space free.
    int every = 1;
    double bundle_rad = ScanBundler::kBundleRad;  ///< see ScanBundler
    /// Radius of the ball around the LiDAR that counts as free at the start: greater than the range in which the LiDAR
    /// is blind, so that the first beams can prove more (decision 25).
    double start_clear_m = 1.2;
    bool clutter = false;  ///< rain or dust may return beams: ClutterFilter
  };

  /// @param lidar   its share of lost returns enters the map's criterion as no_return_p.
  /// @param config  its `map.criterion.no_return_p` is not read.
  WorldMapper(const LidarConfig& lidar, const Config& config);

  /// Enters a scan. Call it with all scans of the LiDAR, in order. It ignores scans in doubt (ScanDoubt), and those
  /// whose tick is no multiple of `every` scan periods. The first one used marks the ball at the start as free.
  void insert(const BeamScan& scan);

  const WorldMap& map() const { return map_; }
  WorldMap& map() { return map_; }

 private:
  Config config_;
  Tick period_;
  WorldMap map_;
  ScanBundler bundler_;
  RepeatedScans repeated_;
  ClutterFilter clutter_;
  std::vector<Eigen::Vector3f> hits_W_;  ///< of one scan, without clutter
  bool started_ = false;
};

}  // namespace skein::agent
