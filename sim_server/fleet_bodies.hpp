// What the bodies of a fleet are, in its order.   Units: m.   Pure.
#pragma once

#include <vector>

#include "core/scenario.hpp"
#include "core/vehicle/airframe.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

inline std::vector<BodyShape> body_shapes(const Scenario& scenario) {
  std::vector<BodyShape> shapes;
  for (const UavConfig& uav : scenario.fleet) shapes.push_back(body_shape(uav.vehicle));
  return shapes;
}

/// Of Bo above the ground on which a UAV stands.
inline std::vector<double> rest_heights(const Scenario& scenario) {
  std::vector<double> heights;
  for (const UavConfig& uav : scenario.fleet) heights.push_back(rest_height(uav.vehicle));
  return heights;
}

}  // namespace skein::sim
