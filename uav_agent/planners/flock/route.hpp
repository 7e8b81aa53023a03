// Chooses the next views: a short route that gains most per second. Targets that one view of the route shows count no
// more for the views after it, and neither do those that other UAVs have announced.
// Frame W.   Units: SI.   Pure and deterministic.   Effort: kMostFirst * depth * views.
#pragma once

#include <vector>

#include "uav_agent/planners/flock/views.hpp"

namespace skein::agent {

/// Assumed motion between views.
struct FlockPace {
  static constexpr double kFarM = 10.0;  ///< longer ways are flown fast; chosen

  double near_mps = FlockConfig().inspect_mps, far_mps = FlightConfig().approach_mps;  ///< on short and on long ways
  double gimbal_radps = 1.0;       ///< vehicle: somewhat less than GimbalConfig::rate_limit_deg_s
  double stop_s = 0.4;             ///< time for a picture at a view; chosen
  double acceleration_mps2 = 2.4;  ///< of a UAV on a long way; chosen
};

struct FlockRoute {
  std::vector<std::size_t> views;   ///< indices of views, in the order of visit
  double gain = 0.0, time_s = 0.0;  ///< gain in points; later views weigh less in both
  /// [points/s]
  double rate() const { return time_s > 0.0 ? gain / time_s : 0.0; }
};

/// @param p_W, direction_W  where the UAV begins, and the unit direction in which its camera looks.
/// @param current  index of the view that it flies to already; another one must be clearly better to replace it.
/// @returns no views if none has a gain worth the flight.
FlockRoute find_route(const std::vector<FlockView>& views, const FlockTargets& targets, const VoxelGrid& grid,
                      const Vector3d& p_W, const Vector3d& direction_W, const FlockPace& pace, double prove_gain,
                      int depth, std::optional<std::size_t> current);

/// Time from a place and a camera direction to a view, picture included [s].
double way_s(const VoxelGrid& grid, const Vector3d& from_W, const Vector3d& direction_W, const FlockView& to,
             const FlockPace& pace);

}  // namespace skein::agent
