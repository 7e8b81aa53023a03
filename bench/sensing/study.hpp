// One flight at a site, and what the map of key frames and the world map know of it at some times.
// Frame W.   Units: SI.   Deterministic, but for CPU times.
#pragma once

#include <array>
#include <vector>

#include "bench/sensing/picture.hpp"
#include "bench/sensing/sites.hpp"

namespace skein::bench {

/// Space by its distance from the route.
struct Band {
  double from_m = 0.0, to_m = 0.0;
  double free_m3 = 0.0;             ///< truly: half a metre from what stands there, and from the ground
  double today = 0.0, world = 0.0;  ///< share of it that the maps call free
};

/// Drawn places on the surface of what stands there, within 20 m of the route: what the maps say of them.
struct Surface {
  int places = 0;
  int today_free = 0, today_occupied = 0, world_free = 0, world_occupied = 0;
};

struct Snapshot {
  double time_s = 0.0;  ///< since the UAV began to hover
  PictureRow level, upright;
  std::array<Band, 3> bands = {Band{0.0, 10.0}, Band{10.0, 20.0}, Band{20.0, 40.0}};
  Surface surface;
  double insert_cpu_s = 0.0;  ///< of WorldMapper::insert() so far
  std::size_t world_bytes = 0;
};

/// What the LiDAR's messages of a flight are on the wire, in bytes of CDR.
struct Messages {
  std::size_t scans = 0, points = 0, cloud_bytes = 0, most_cloud_bytes = 0, servo_bytes = 0;
};

struct SiteStudy {
  std::string name, stem;
  Picture level, upright;
  std::vector<Snapshot> snapshots;
  Messages messages;
  int rays = 0;  ///< that must pass a place at this site before planners of key frames take it for free
};

/// @param times_s  of snapshots, ascending, since the UAV began to hover.
/// @throws std::runtime_error when it does not get that far.
SiteStudy study_of(const Site& site, const std::vector<double>& times_s, std::uint64_t seed);

}  // namespace skein::bench
