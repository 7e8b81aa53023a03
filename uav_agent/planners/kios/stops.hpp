// The second stage of KIOS: waypoints around the occupied cubes, one for each exposed face, with a direction for the
// camera; and who of the UAVs in line of sight visits which. A face that was photographed is marked in the grid, and
// the mark travels with the map.
// Frame W.   Units: SI.   Pure but for the failures it remembers.   Effort: bounded by counts.
// Source: paper, "Cooperative Inspection". Where exactly in the free cube the UAV stops, and all numbers, are our
// choice (the paper has none).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/world_voxels.hpp"

namespace skein::agent {

/// One waypoint.
struct KiosStop {
  std::uint32_t id = 0;                   ///< of the face: 6 * cube + face
  Vector3d p_WB = Vector3d::Zero();       ///< where the UAV stops
  Vector3d surface_W = Vector3d::Zero();  ///< where its camera looks
  Vector3d out_W = Vector3d::UnitX();     ///< outward normal of the face
  bool proved = true;                     ///< that a body may be there; else only a UAV with a LiDAR can go

  VoxelGrid::Id cube() const { return id / VoxelGrid::kFaces; }
  int face() const { return static_cast<int>(id % VoxelGrid::kFaces); }
};

/// A UAV among whom the stops are shared out.
struct KiosAgent {
  Vector3d p_WB = Vector3d::Zero();  ///< where it begins
  double busy_s = 0.0;               ///< what it has to do before
};

class KiosStops {
 public:
  struct Config {
    double sharp_m = 7.36;         ///< d*: no farther from the surface
    double nearest_ratio = 0.6;    ///< no nearer to it where there is room, of d*
    double standoff_ratio = 0.92;  ///< at most, of d*
    int min_hits = 1;              ///< mapped cells that make a cube occupied
    double speed_mps = 4.0;        ///< between stops
    double stop_s = 2.0;           ///< that a stop takes, braking included
    std::size_t max_tasks = 150;   ///< shared out in one go; the nearest ones
    std::size_t effort = 60'000;   ///< evaluated moves
    double retry_s = 12.0;         ///< before a stop that could not be reached is tried again
  };

  explicit KiosStops(const Config& config) : config_(config) {}

  struct Open {
    std::vector<KiosStop> stops;
    std::size_t out_of_reach = 0;  ///< exposed faces without a place to stop at, as far as is known
  };
  /// All faces of known surface inside the boxes that are exposed and not photographed yet.
  Open open_stops(const VoxelGrid& grid, const WorldVoxels& voxels, const FreeSpace& space,
                  const std::vector<OrientedBox>& boxes, Tick now) const;

  /// The tour of agents[self] when all of them share the stops out, as an order of indices into `stops`.
  /// @param grid  has what is in between.
  std::vector<std::size_t> own_tour(const std::vector<KiosStop>& stops, const std::vector<KiosAgent>& agents,
                                    std::size_t self, const VoxelGrid& grid) const;

  /// Something else first.
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
