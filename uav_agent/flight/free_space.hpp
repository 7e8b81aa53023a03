// Where a planner may plan paths, as far as this UAV knows: clear of structure and of other UAVs. With the world map of
// all beams, unproved space is passable, at a cost, or excluded (Config::proved_only). Without it, space in and near
// boxes is excluded until key frames prove it free. The safety filter checks again before the UAV flies
// (flight_core/safety_filter.hpp).
// Frame W.   Units: metres.   Pure; threads: any, as long as the map does not change.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/flight/body_fit.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// A ball that the UAV's centre must not enter, around another UAV.
struct Sphere {
  Vector3d p_W = Vector3d::Zero();
  double radius_m = 0.0;
};

class FreeSpace {
 public:
  struct Config {
    double clearance_m = 1.8;  ///< least distance of the UAV's centre to structure; chosen
    double floor_m = 2.0;      ///< least height; chosen
    /// The world map of all beams; must outlive this. Paths may lead through unknown space, at a cost, because the
    /// safety filter lets the UAV enter only proved space. nullptr: key frames show structure, and paths keep clear of
    /// boxes where key frames have not proved free space.
    const WorldMap* world = nullptr;
    /// Boxes count as larger by this on each side, or by clearance_m if that is more. Chosen.
    double jut_m = 3.0;
    bool use_map = true;           ///< false: ignores the map, excludes boxes as a whole; not with `world`
    double unknown_cost = 1.0;     ///< cost() where the body does not fit in proved space; chosen
    const BodyFit* fit = nullptr;  ///< where the body fits in proved space; must outlive this
    /// Excludes unproved space, for a UAV that cannot prove space itself. Needs `fit`.
    bool proved_only = false;
    bool blind_fleet = false;  ///< with `world`: keeps clear of all boxes, because no map proves space free, ...
    std::optional<Vector3d> way_out_W = {};  ///< ... but not straight below this place: there, the UAV leaves a box
  };

  /// @param boxes, map  must outlive this.
  FreeSpace(const Config& config, const std::vector<OrientedBox>& boxes, const OccupancyMap& map,
            std::vector<Sphere> keep_out = {})
      : config_(config), boxes_(boxes), map_(map), keep_out_(std::move(keep_out)) {}

  bool free(const Vector3d& p_W) const;
  /// Whether all points of the segment are free; sampled every 0.5 m.
  bool segment_free(const Vector3d& a_W, const Vector3d& b_W) const;
  /// Cost of a metre of path at p, in metres of path through proved space.
  double cost(const Vector3d& p_W) const;
  /// For a start a_W that is not free: whether the segment leads out of there. It must enter no structure and no ball
  /// around another UAV, and come at most 0.3 m nearer to structure than a_W is.
  bool leads_out(const Vector3d& a_W, const Vector3d& b_W) const;
  /// Line of sight as far as map and boxes tell: no occupied cell of the map of key frames within `radius` of the
  /// segment (with use_map), and all parts of it that lie in boxes are known to be free.
  bool sees(const Vector3d& a_W, const Vector3d& b_W, double radius) const;

  const Config& config() const { return config_; }
  const OccupancyMap& map() const { return map_; }

 private:
  bool near_box(const Vector3d& p_W) const;
  bool kept_out(const Vector3d& p_W) const;
  double structure_distance_m(const Vector3d& p_W) const;
  /// free() without the conditions on clearance to structure and on proof by the world map.
  bool allowed(const Vector3d& p_W) const;

  const Config config_;
  const std::vector<OrientedBox>& boxes_;
  const OccupancyMap& map_;
  const std::vector<Sphere> keep_out_;
};

}  // namespace skein::agent
