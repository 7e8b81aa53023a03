// Where this UAV may choose to fly, as far as it knows: not into structure, not into another UAV; and by the map of all
// beams, or by boxes and key frames alone, not where nothing was proved. The safety filter asks anew before anybody
// flies (flight_core/safety_filter.hpp).
// Frame W.   Units: metres.   Pure; threads: any, as long as the map does not change.
#pragma once

#include <vector>

#include "uav_agent/flight/body_fit.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// A place to keep away from: another UAV.
struct Sphere {
  Vector3d p_W = Vector3d::Zero();
  double radius_m = 0.0;
};

class FreeSpace {
 public:
  struct Config {
    double clearance_m = 1.8;  ///< of the UAV's centre to structure, and to boxes that must be kept off
    double floor_m = 2.0;
    /// The map of all beams: what is unknown may be planned through, at a cost, since it is proved before anybody flies
    /// there. Must outlive this. Without it, what key frames show is structure, and boxes are kept off where nobody has
    /// looked.
    const WorldMap* world = nullptr;
    double jut_m = 3.0;            ///< so far outside a box there may be structure, too; never less than clearance_m
    bool use_map = true;           ///< without `world`: false knows of the boxes alone
    double unknown_cost = 1.0;     ///< of a metre, in metres
    const BodyFit* fit = nullptr;  ///< what is proved of it; must outlive this
    /// For who proves nothing itself: unknown space may not be planned through.
    bool proved_only = false;
    bool blind_fleet = false;  ///< nobody has a LiDAR: boxes are kept clear of
  };

  /// @param boxes, map  must outlive this.
  FreeSpace(const Config& config, const std::vector<OrientedBox>& boxes, const OccupancyMap& map,
            std::vector<Sphere> keep_out = {})
      : config_(config), boxes_(boxes), map_(map), keep_out_(std::move(keep_out)) {}

  bool free(const Vector3d& p_W) const;
  /// Every point of the segment is free.
  bool segment_free(const Vector3d& a_W, const Vector3d& b_W) const;
  /// What a metre costs there, in metres.
  double cost(const Vector3d& p_W) const;
  /// Whether the segment leads out of a place that is not free: no nearer to structure than that place, or hardly.
  bool leads_out(const Vector3d& a_W, const Vector3d& b_W) const;
  /// Line of sight as far as map and boxes tell: no mapped cell within `radius` of the segment, no unknown box
  /// on it.
  bool sees(const Vector3d& a_W, const Vector3d& b_W, double radius) const;

  const Config& config() const { return config_; }
  const OccupancyMap& map() const { return map_; }

 private:
  bool near_box(const Vector3d& p_W) const;
  double structure_distance_m(const Vector3d& p_W) const;
  /// As free(), but for the clearance to structure, and for proof by the map of all beams.
  bool allowed(const Vector3d& p_W) const;

  const Config config_;
  const std::vector<OrientedBox>& boxes_;
  const OccupancyMap& map_;
  const std::vector<Sphere> keep_out_;
};

}  // namespace skein::agent
