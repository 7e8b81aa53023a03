// Keeps a WorldMap from the scans of a LiDAR.
// Frames: W world, B body.   Units: metres.   Threads: one.   Deterministic.
#pragma once

#include "uav_agent/maps/scan_bundles.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class WorldMapper {
 public:
  struct Config {
    WorldMap::Config map = {};
    /// Each so many scans one is taken in. All are affordable, and what they prove goes with their number.
    int every = 1;
    double bundle_rad = ScanBundler::kBundleRad;
    /// Where it was put down, so much about its LiDAR is clear: more than the LiDAR is blind (decision 25).
    double start_clear_m = 1.2;
  };

  /// @param lidar   tells how many returns are lost, which the map's criterion accounts for.
  /// @param config  its `map.criterion.no_return_p` is not read.
  WorldMapper(const LidarConfig& lidar, const Config& config);

  /// All scans of the LiDAR in their order: those that are not taken in are counted. The first tells of the start.
  void insert(const BeamScan& scan);

  const WorldMap& map() const { return map_; }
  WorldMap& map() { return map_; }

 private:
  Config config_;
  Tick period_;
  WorldMap map_;
  ScanBundler bundler_;
  RepeatedScans repeated_;
  bool started_ = false;
};

}  // namespace skein::agent
