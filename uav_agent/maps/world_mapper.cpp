#include "uav_agent/maps/world_mapper.hpp"

#include <algorithm>

#include "core/vehicle/lidar_geometry.hpp"

namespace skein::agent {
namespace {

/// The config with the share of returns that this LiDAR loses.
WorldMap::Config with_losses(WorldMap::Config config, const LidarConfig& lidar) {
  const double share = lidar.dropped_sectors ? lidar.dropped_sectors->share : 0.0;
  config.criterion.no_return_p = 1.0 - (1.0 - lidar.no_return_p) * (1.0 - share);
  return config;
}

}  // namespace

WorldMapper::WorldMapper(const LidarConfig& lidar, const Config& config)
    : config_(config),
      period_(lidar_period(lidar) * config.every),
      map_(with_losses(config.map, lidar)),
      bundler_(lidar, config.bundle_rad),
      repeated_(config.map.criterion.member_width_m, bundler_.half_rad()) {}

void WorldMapper::insert(const BeamScan& scan) {
  if (scan.doubt != ScanDoubt::none || scan.tick % period_ != 0) return;
  const Isometry3d& X_WL = scan.fired.back().X_WL;
  if (!started_) map_.set_free(X_WL.translation(), config_.start_clear_m);
  started_ = true;
  const RepeatedScans::Repeated repeated = repeated_.ask(X_WL);
  const TubeFree near_free = [&](const Vector3d& a_W, const Vector3d& b_W, double radius_m) {
    return map_.tube_free(a_W, b_W, radius_m);
  };
  ClearWay clear_way;
  if (map_.config().criterion.no_return_p > 0.0) {
    // Beyond this, beams are not evidence at any level, so it does not matter what they meet there.
    const double enough_m = map_.config().to_m.back() + 2.0 * map_.config().cell_m * (1 << (map_.levels() - 1));
    clear_ways_.begin(map_, enough_m);
    clear_way = [this](const Vector3d& from_W, const Vector3d& direction_W, double reach_m) {
      return clear_ways_.clear_way_m(from_W, direction_W, reach_m);
    };
  }
  const ScanBundler::Bundles& bundles = bundler_.bundle(scan, repeated, near_free, clear_way);
  if (!config_.clutter) return map_.insert(bundles.bundles, bundles.hits_W);
  hits_W_ = bundles.hits_W;
  clutter_.keep_confirmed(seconds(scan.tick), X_WL.translation(), map_, hits_W_);
  map_.insert(bundles.bundles, hits_W_);
  clutter_.doubt_new(map_);
}

}  // namespace skein::agent
