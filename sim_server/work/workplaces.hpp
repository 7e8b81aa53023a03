// For each interest point, a place from which it can be photographed in the true scene: the referee's conservative
// estimate of what UAVs can reach.
// Frame W.   Units: m.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim {

/// Workplace for one point and one kind of camera.
struct Workplace {
  Vector3d p_W = Vector3d::Zero();
  double home_m = 0.0;  ///< 0 if the station is in sight from here, else the straight distance to the station
  double q = 0.0;       ///< quality of a picture from here, taken at rest; 0: there is no such place
};

/// There are ten candidates on each side of the surface, as in is_flyable(): at 0.85 of the distance with full
/// resolution and at 0.7 of that, perpendicular to the surface or 31 degrees off. A workplace has a line of sight to
/// the point, and a straight way out of the structure, up or sideways, with 1.4 m clearance. Deterministic; immutable,
/// so safe from any thread.
class Workplaces {
 public:
  static constexpr double kBerth =
      1.4;  ///< clearance that is_flyable() requires, too [m]; sufficient for every vehicle
  static constexpr double kLeastQ = 0.3;  ///< places from which the quality is lower are not workplaces

  Workplaces(const Scenario& scenario, const Scene& scene);

  /// By interest point: the first suitable candidate.
  std::span<const Workplace> of(UavIndex uav) const { return by_kind_.at(kind_of_.at(uav)); }

 private:
  std::vector<std::size_t> kind_of_;             ///< by UAV
  std::vector<std::vector<Workplace>> by_kind_;  ///< by kind of camera and point
};

}  // namespace skein::sim
