// Shapes and rest heights of all UAVs of a scenario, in fleet order.   Units: m.   Pure.
#pragma once

#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/vehicle/airframe.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Shape of each body, in its frame B.
inline std::vector<BodyShape> body_shapes(const Scenario& scenario) {
  std::vector<BodyShape> shapes;
  for (const UavConfig& uav : scenario.fleet) shapes.push_back(body_shape(uav.vehicle));
  return shapes;
}

/// Height of each body's origin Bo above the ground when the UAV stands on it.
inline std::vector<double> rest_heights(const Scenario& scenario) {
  std::vector<double> heights;
  for (const UavConfig& uav : scenario.fleet) heights.push_back(rest_height(uav.vehicle));
  return heights;
}

}  // namespace skein::sim
