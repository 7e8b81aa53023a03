// The second stage of KIOS: waypoints around the occupied cubes, one for each exposed face, with a direction for the
// camera; and the assignment of waypoints to the UAVs in line of sight. A photographed face is marked in the grid, and
// UAVs exchange the marks with the map.
// Frame W.   Units: SI.   Pure except for the remembered failures.   Effort: bounded by counts.
// Source: paper, "Cooperative Inspection". Where exactly in the free cube the UAV stops, and all numbers, are our
// choice (the paper has none).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/world_voxels.hpp"
#include "uav_agent/planners/kios/config.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {

/// One waypoint.
struct KiosStop {
  std::uint32_t id = 0;                   ///< id of the face: 6 * cube + face
  Vector3d p_WB = Vector3d::Zero();       ///< where the UAV stops
  Vector3d surface_W = Vector3d::Zero();  ///< point at which its camera aims
  Vector3d out_W = Vector3d::UnitX();     ///< outward normal of the face
  bool proved = true;                     ///< the place is proved free; if not, only a UAV with a LiDAR can go there

  VoxelGrid::Id cube() const { return id / VoxelGrid::kFaces; }
  int face() const { return static_cast<int>(id % VoxelGrid::kFaces); }
};

/// One of the UAVs among which the stops are divided.
struct KiosAgent {
  Vector3d p_WB = Vector3d::Zero();  ///< where its tour begins
  double busy_s = 0.0;               ///< time until it can begin its tour
};

class KiosStops {
 public:
  struct Config {
    double sharp_m = CameraReach().sharp_distance_m;      ///< d*: greatest distance from the surface
    double nearest_ratio = KiosConfig().nearest_ratio;    ///< least distance where there is room, as a share of d*
    double standoff_ratio = KiosConfig().standoff_ratio;  ///< greatest distance of a stop, as a share of d*
    int min_hits = 1;                     ///< least number of mapped cells in an occupied cube of this UAV's own map
    double speed_mps = 4.0;               ///< assumed speed between stops; chosen
    double stop_s = KiosConfig().stop_s;  ///< assumed duration of a stop, braking included
    /// Most stops divided at once: those nearest to any of the UAVs.
    std::size_t max_tasks = static_cast<std::size_t>(KiosConfig().max_tasks);
    /// Most moves that the tour search evaluates.
    std::size_t effort = static_cast<std::size_t>(KiosConfig().effort);
    double retry_s = 12.0;  ///< wait before an unreachable stop is tried again, times its failures so far; chosen
  };

  explicit KiosStops(const Config& config) : config_(config) {}

  struct Open {
    std::vector<KiosStop> stops;
    std::size_t out_of_reach = 0;  ///< exposed faces without a known place to stop at
  };
  /// A stop for each exposed face inside the boxes that is not photographed yet and did not fail a moment ago.
  Open open_stops(const VoxelGrid& grid, const WorldVoxels& voxels, const FreeSpace& space,
                  const std::vector<OrientedBox>& boxes, Tick now) const;

  /// Divides the stops among all agents. @returns the tour of agents[self]: indices into `stops`, in order of visit.
  /// @param grid  tells whether structure lies between two places.
  std::vector<std::size_t> own_tour(const std::vector<KiosStop>& stops, const std::vector<KiosAgent>& agents,
                                    std::size_t self, const VoxelGrid& grid) const;

  /// This stop could not be reached: open_stops() leaves it out for a while (Config::retry_s).
  void failed(std::uint32_t stop, Tick now);

 private:
  std::optional<KiosStop> stop_at(std::uint32_t id, const VoxelGrid& grid, const Vector3d& surface_W,
                                  const FreeSpace& space) const;

  struct Failure {
    int count = 0;
    Tick not_before = 0;
  };

  const Config config_;
  std::map<std::uint32_t, Failure> failures_;  ///< by stop
};

}  // namespace skein::agent
