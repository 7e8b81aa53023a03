// One flight at a site, and the knowledge of the map of key frames and of the world map at several times.
// Frame W.   Units: SI.   Deterministic, but for CPU times.
#pragma once

#include <array>
#include <vector>

#include "bench/sensing/picture.hpp"
#include "bench/sensing/sites.hpp"

namespace skein::bench {

/// The space within a range of distances from the route.
struct Band {
  double from_m = 0.0, to_m = 0.0;
  double free_m3 = 0.0;             ///< volume at least 0.5 m away from structure and ground
  double today = 0.0, world = 0.0;  ///< share of `free_m3` that the maps know to be free
};

/// Numbers of sample points on the structure's surface within 20 m of the route, by what the maps know of them.
struct Surface {
  int places = 0;
  int today_free = 0, today_occupied = 0, world_free = 0, world_occupied = 0;
};

struct Snapshot {
  double time_s = 0.0;  ///< since the UAV began to hover
  PictureRow level, upright;
  std::array<Band, 3> bands = {Band{0.0, 10.0}, Band{10.0, 20.0}, Band{20.0, 40.0}};
  Surface surface;
  double insert_cpu_s = 0.0;    ///< CPU time of WorldMapper::insert() since the hover began
  std::size_t world_bytes = 0;  ///< memory of the world map
};

/// The LiDAR's messages of a flight, with their sizes as CDR [bytes]; `servo_bytes` is the largest.
struct Messages {
  std::size_t scans = 0, points = 0, cloud_bytes = 0, most_cloud_bytes = 0, servo_bytes = 0;
};

struct SiteStudy {
  std::string name, stem;
  Picture level, upright;
  std::vector<Snapshot> snapshots;
  Messages messages;
  int rays = 0;  ///< that must pass a place before planners with the map of key frames consider it free
};

/// @param times_s  times of the snapshots since the UAV began to hover [s], ascending.
/// @throws std::runtime_error if the explorer crashes before the last one.
SiteStudy study_of(const Site& site, const std::vector<double>& times_s, std::uint64_t seed);

}  // namespace skein::bench
