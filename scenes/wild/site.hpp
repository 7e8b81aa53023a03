// What is drawn of a wild scene, step by step: a task that a fleet can do, structures of that size, starts and station
// about them, boxes, clutter. Part of world.cpp.
// Frame W.   Units: m, s, mm.
#pragma once

#include <string>
#include <vector>

#include "core/scenario.hpp"
#include "scenes/wild/shapes.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim::wild {

/// The streams of one draw.
struct Dice {
  std::uint64_t seed = 0;
  std::uint64_t attempt = 0;
  RandomStream stream(const char* purpose) const { return {seed, purpose, 0, attempt}; }
};

struct Task {
  std::vector<Role> fleet;  ///< in its order
  double mm_per_pixel = 2.0, duration_s = 600.0;
  double area_m2 = 1000.0;  ///< of surface, about
};
/// @param blind  nobody has a LiDAR.
Task draw_task(const Dice& dice, bool blind);

/// A structure as it stands: a circle around its footprint, and the box that would fit it.
struct Standing {
  Vector2d p_W = Vector2d::Zero();
  double radius = 0.0, heading = 0.0, height = 0.0;
  TriangleMesh mesh;
};
std::vector<Standing> draw_structures(const Dice& dice, double area_m2);

/// Where everybody begins. `walls` stand beside starts, a canopy above them; none of it in a blind fleet.
struct Starts {
  std::vector<Vector2d> p_W;
  std::vector<double> yaw;
  Vector3d station_W = Vector3d::Zero();
  TriangleMesh beside;
};
/// @returns without starts when no room was found.
Starts draw_starts(const Dice& dice, const std::vector<VehicleConfig>& fleet, const std::vector<Standing>& structures,
                   const TriangleMesh& mesh, bool blind);

std::vector<OrientedBox> draw_boxes(const Dice& dice, const std::vector<Standing>& structures,
                                    const std::vector<Vector2d>& starts);

/// Trees and cables outside all boxes.
TriangleMesh draw_clutter(const Dice& dice, const std::vector<Standing>& structures,
                          const std::vector<OrientedBox>& boxes, const Starts& starts);

/// Whether any vertex lies in a box.
bool in_any_box(const TriangleMesh& mesh, const std::vector<OrientedBox>& boxes);

}  // namespace skein::sim::wild
