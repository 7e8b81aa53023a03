// All beams of one LiDAR scan, including those without a return.
// Frames: W world, B body, L LiDAR (core/vehicle/lidar_geometry.hpp defines the directions of its beams in L).
// Units: SI, radians.
//
// What a beam proves, and what it does not:
// - `none` says that nothing stands between the LiDAR's range_min_m and range_max_m. The LiDAR also drops a return from
//   nearer than range_min_m. So other evidence must prove the first range_min_m free before a `none` beam counts as
//   free (maps/scan_bundles.hpp). A `range` beam needs no such proof: its hit is the first object on the beam.
// - A LiDAR may lose returns (`no_return_p` and `dropped_sectors` of LidarConfig). Then a beam that hit something may
//   be `none`, too, and nothing distinguishes it from a beam that hit nothing.
// - Beams are not independent evidence. The rings are 2 degrees apart, and in four scans (0.4 s) the servo turns by
//   nine times that angle about body x: beams to the side of the body then coincide with earlier ones. The servo's
//   period (8 s) is a whole number of scans, so the LiDAR of a hovering UAV fires along the same lines in every period.
//   It misses an object between two lines every time (maps/repeated_scans.hpp leaves such scans out).
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

enum class BeamState : std::uint8_t {
  unknown,  ///< the scan is in doubt, or the beam had no return and may have passed another UAV's body
  none,     ///< no return
  range,    ///< hit something, but no known UAV
  uav,      ///< hit the known body of another UAV
};

/// Why all beams of a scan are `unknown`.
enum class ScanDoubt : std::uint8_t {
  none,
  no_servo,  ///< the servo's angles are missing or inconsistent
  no_pose,   ///< odometry at the time of the scan is missing
  misfit,    ///< some point lies on no beam from the assumed pose: odometry or servo angle is wrong
};

struct BeamScan {
  struct Beam {
    BeamState state = BeamState::unknown;
    float range_m = 0.0F;  ///< distance from L to the hit; only if `range` or `uav`
  };
  /// Columns that the LiDAR fired at the same tick.
  struct Firing {
    int first_column = 0;  ///< the columns from this one up to first_column of the next firing
    Tick tick = 0;         ///< when they were fired; X_WL is the LiDAR's pose then
    Isometry3d X_WL = Isometry3d::Identity();
    double error_m = 0.0, error_rad = 0.0;  ///< bounds of the error of X_WL that interpolation adds to the odometry's
  };

  Tick tick = 0;  ///< time stamp of the scan
  ScanDoubt doubt = ScanDoubt::none;
  int columns = 0;                 ///< number of columns, i.e. beams per ring
  std::vector<Beam> beams = {};    ///< the lowest ring first; in a ring by azimuth in L, from -pi
  std::vector<Firing> fired = {};  ///< in order of columns; empty unless `doubt` is none
  /// Number of returns. Each confirms the pose; a scan into empty space has none, so nothing checks its pose.
  std::size_t points = 0;

  const Beam& beam(int ring, int column) const { return beams[static_cast<std::size_t>(ring * columns + column)]; }
  /// The firing of a column. Call it only if `doubt` is none.
  const Firing& firing(int column) const {
    std::size_t i = fired.size() - 1;
    while (i > 0 && fired[i].first_column > column) --i;
    return fired[i];
  }
};

}  // namespace skein::agent
