// Where this UAV may fly, as far as it knows: not into mapped structure, not into a box, or near to one, whose inside
// it has not seen, not into the low unknown between the boxes (podiums and trees are in no box), not into another UAV.
// Frame W.   Units: metres.   Pure; threads: any, as long as the map does not change.
#pragma once

#include <string_view>
#include <vector>

#include "uav_agent/flight/body_fit.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/voxel_grid.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

inline constexpr double kAnywhereM = 1e6;  ///< enter_radius_m of who may enter boxes wherever they were seen to be free

/// A place to keep away from: another UAV.
struct Sphere {
  Vector3d p_W = Vector3d::Zero();
  double radius_m = 0.0;
};

/// Why a place may not be entered: the first of these that holds.
enum class Barrier {
  none,       ///< it may
  floor,      ///< below floor_m
  other_uav,  ///< in a place to keep away from
  told,       ///< others told of something there (hearsay)
  unseen,     ///< in or near a box, or below blind_height_m, and no LiDAR has seen that it is free
  aside,      ///< inside a box, and not near a place of enter_near_W
  mapped,     ///< nearer than clearance_m to something on the map
};

/// For a log: "nearer than the clearance to something on the map".
std::string_view to_string(Barrier barrier);

class FreeSpace {
 public:
  struct Config {
    double clearance_m = 1.8;  ///< of the UAV's centre to mapped cells and to unknown boxes
    double floor_m = 2.0;
    double blind_height_m = 0.0;  ///< below, only space that was seen to be free may be entered
    double jut_m = 3.0;           ///< so far outside a box there may be structure, too; never less than clearance_m
    int rays = kProofRays;        ///< that must have passed a place where only what was seen may be entered
    /// If not empty, boxes may only be entered this near to one of these places, however much was seen of
    /// their inside: a way from here to there does not lead through a building.
    std::vector<Vector3d> enter_near_W = {};
    double enter_radius_m = 9.0;
    bool use_map = true;
    /// What others have told, if anything: what is occupied there is kept clear of, what is free counts as seen.
    /// Must outlive this.
    const VoxelGrid* hearsay = nullptr;
    /// The map of all beams, for who is flown by the flight core: then space that is unknown may be planned through,
    /// at a cost, since the safety filter proves it before anybody flies there. Must outlive this.
    const WorldMap* world = nullptr;
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
  /// Why not, if not.
  Barrier barrier(const Vector3d& p_W) const;
  /// Every point of the segment is free.
  bool segment_free(const Vector3d& a_W, const Vector3d& b_W) const;
  /// What a metre costs there, in metres.
  double cost(const Vector3d& p_W) const;
  /// Somebody has looked (kFewestRays) wherever only what was seen may be entered, farther than `body_m` from `a_W`.
  bool looked_at(const Vector3d& a_W, const Vector3d& b_W, double body_m) const;
  /// Line of sight as far as map and boxes tell: no mapped cell within `radius` of the segment, no unknown box
  /// on it.
  bool sees(const Vector3d& a_W, const Vector3d& b_W, double radius) const;

  const Config& config() const { return config_; }
  const OccupancyMap& map() const { return map_; }

 private:
  bool near_box(const Vector3d& p_W) const;
  /// In or near a box, or low: not free until a LiDAR has seen that it is.
  bool must_be_seen(const Vector3d& p_W) const;
  bool seen_free(const Vector3d& p_W) const;
  /// Whether others told of something within reach of p.
  bool near_hearsay(const Vector3d& p_W) const;
  /// As barrier(), but without the mapped cells.
  Barrier barrier_off_map(const Vector3d& p_W) const;
  bool allowed(const Vector3d& p_W) const { return barrier_off_map(p_W) == Barrier::none; }

  const Config config_;
  const std::vector<OrientedBox>& boxes_;
  const OccupancyMap& map_;
  const std::vector<Sphere> keep_out_;
};

/// How near a UAV may come to something mapped that is nearer than its clearance already, on its way out.
/// @param now_m  how far it is off.   @param slack_m  by so much nearer than that, but not where little is left of the
///   clearance: whoever tries again and again would come nearer each time.
double least_on_way_out_m(double now_m, double clearance_m, double slack_m);

}  // namespace skein::agent
