#include "uav_agent/maps/scan_beams.hpp"

#include "core/lidar_geometry.hpp"

namespace skein::agent {

std::vector<Beam> map_beams(const BeamScan& scan, const LidarConfig& lidar, const SegmentFree& near_free) {
  std::vector<Beam> beams;
  if (scan.doubt != ScanDoubt::none) return beams;
  beams.reserve(scan.beams.size());
  for (int ring = 0; ring < lidar.rings; ++ring) {
    for (int column = 0; column < lidar.columns; ++column) {
      const BeamScan::Beam& beam = scan.beam(ring, column);
      if (beam.state == BeamState::unknown) continue;
      const Isometry3d& X_WL = scan.firing(column).X_WL;
      const Vector3d from_W = X_WL.translation();
      const Vector3d direction_W = X_WL.linear() * lidar_direction_L(lidar, ring, column);
      const bool none = beam.state == BeamState::none;
      if (none && !near_free(from_W, from_W + lidar.range_min_m * direction_W)) continue;
      beams.push_back({.from_W = from_W,
                       .direction_W = direction_W.cast<float>(),
                       .free_m = none ? static_cast<float>(lidar.range_max_m) : beam.range_m,
                       .returned = beam.state == BeamState::range});
    }
  }
  return beams;
}

}  // namespace skein::agent
