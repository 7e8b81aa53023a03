// Where each interest point may be photographed from, by the true scene: what the referee takes to be within a UAV's
// reach. It leaves out much that a UAV could do.
// Frame W.   Units: m.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/scenario.hpp"
#include "core/scene.hpp"

namespace skein::sim {

/// Of one point and one kind of camera.
struct Workplace {
  Vector3d p_W = Vector3d::Zero();
  double home_m = 0.0;  ///< from there to where the station is in sight, by a straight line: 0, or to the station
  double q = 0.0;       ///< of a picture from there, taken at rest; 0: there is no such place
};

/// A place is one of ten in front of each side of the surface, as in is_flyable(): at 0.85 of the distance with full
/// resolution and at 0.7 of that, straight or up to 31 degrees aside. From there the point is in sight, and a straight
/// line leads past all structures, up or aside, 1.4 m from everything. Deterministic; immutable.
class Workplaces {
 public:
  static constexpr double kBerth = 1.4;   ///< as worlds are proved to be flyable: every vehicle fits
  static constexpr double kLeastQ = 0.3;  ///< what can only be seen worse is not held against anybody

  Workplaces(const Scenario& scenario, const Scene& scene);

  /// By interest point: the first place of the ten that will do.
  std::span<const Workplace> of(UavIndex uav) const { return by_kind_.at(kind_of_.at(uav)); }

 private:
  std::vector<std::size_t> kind_of_;             ///< by UAV
  std::vector<std::vector<Workplace>> by_kind_;  ///< of camera
};

}  // namespace skein::sim
