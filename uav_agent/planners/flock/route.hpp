// Which views to take next: some of them one after the other, so that what is gained a second is most. What one view
// of the route shows counts no more for those after it, and neither does what other UAVs have announced.
// Frame W.   Units: SI.   Pure and deterministic.   Effort: kMostFirst * depth * views.
#pragma once

#include <vector>

#include "uav_agent/planners/flock/views.hpp"

namespace skein::agent {

/// How long it takes from view to view.
struct FlockPace {
  double near_mps = 2.5, far_mps = 5.0;
  double gimbal_radps = 1.0;
  double stop_s = 0.4;
  double acceleration_mps2 = 2.4;
};

struct FlockRoute {
  std::vector<std::size_t> views;  ///< indices, in the order of visit
  double gain = 0.0, time_s = 0.0;
  double rate() const { return time_s > 0.0 ? gain / time_s : 0.0; }
};

/// @param p_W, aim_W  where the UAV begins, and looks.
/// @param current  index of the view that it flies to already, which is kept unless another is clearly better.
FlockRoute find_route(const std::vector<FlockView>& views, const FlockTargets& targets, const VoxelGrid& grid,
                      const Vector3d& p_W, const Vector3d& direction_W, const FlockPace& pace, double prove_gain,
                      int depth, std::optional<std::size_t> current);

/// From one place and direction to a view [s].
double way_s(const VoxelGrid& grid, const Vector3d& from_W, const Vector3d& direction_W, const FlockView& to,
             const FlockPace& pace);

}  // namespace skein::agent
