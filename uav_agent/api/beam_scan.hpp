// All beams of one LiDAR scan, those that returned nothing among them.
// Frames: W world, B body, L LiDAR (core/vehicle/lidar_geometry.hpp has where its beams point).   Units: SI, radians.
//
// What a beam proves, and what it does not:
// - `none` says that nothing stands between the LiDAR's range_min_m and range_max_m. The LiDAR drops what is nearer as
//   it drops a miss, so the first range_min_m must be known to be free from elsewhere before anything is taken for
//   free (maps/scan_bundles.hpp). A `range` beam needs no such proof: what it met is the first that stands there.
// - A LiDAR may lose returns (`no_return_p` and `dropped_sectors` of LidarConfig). Then a beam that met something may
//   be `none`, too, and looks no different.
// - Beams are no independent witnesses. Rings are evenly spaced (2 degrees), and in four scans (0.4 s) the servo turns
//   by nine spacings: sideways, where turning moves a beam across the rings, beams fall onto lines of beams before. The
//   servo's period (8 s) is a whole number of scans, so that a LiDAR that hangs still fires along all its lines again.
//   What slips between two lines slips between them each time (maps/repeated_scans.hpp leaves such scans out).
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

enum class BeamState : std::uint8_t {
  unknown,  ///< it may have returned something, or passed where another UAV is
  none,     ///< it returned nothing
  range,    ///< it met something
  uav,      ///< it met another UAV: no structure
};

/// Why nothing is known of any beam of a scan.
enum class ScanDoubt : std::uint8_t {
  none,
  no_servo,  ///< the servo's angles are missing, or do not belong together
  no_pose,   ///< the odometry about its time is missing
  misfit,    ///< its points are not where beams from there would have made them: odometry or servo are wrong
};

struct BeamScan {
  struct Beam {
    BeamState state = BeamState::unknown;
    float range_m = 0.0F;  ///< of `range` and `uav`
  };
  /// Columns that were fired together.
  struct Firing {
    int first_column = 0;  ///< up to that of the next firing
    Tick tick = 0;
    Isometry3d X_WL = Isometry3d::Identity();
    double error_m = 0.0, error_rad = 0.0;  ///< bounds of what interpolation adds to the odometry's errors
  };

  Tick tick = 0;  ///< of the scan
  ScanDoubt doubt = ScanDoubt::none;
  int columns = 0;                 ///< of a ring
  std::vector<Beam> beams = {};    ///< ring by ring upwards, in each by azimuth from -pi
  std::vector<Firing> fired = {};  ///< by column; empty if there is a doubt
  /// Points that confirm the pose: a scan into empty sky has none, and then the odometry is believed unasked.
  std::size_t points = 0;

  const Beam& beam(int ring, int column) const { return beams[static_cast<std::size_t>(ring * columns + column)]; }
  /// Only without doubt.
  const Firing& firing(int column) const {
    std::size_t i = fired.size() - 1;
    while (i > 0 && fired[i].first_column > column) --i;
    return fired[i];
  }
};

}  // namespace skein::agent
