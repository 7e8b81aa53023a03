// The steps in which a wild scene is drawn: a task that suits the fleet, structures with the area of the task, starts
// and station around them, boxes, clutter. Part of world.cpp.
// Frame W.   Units: m, s, mm.   Pure: the same dice give the same scene.   Threads: any.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "scenes/wild/shapes.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim::wild {

/// The random streams of one attempt to draw a scene.
struct Dice {
  std::uint64_t seed = 0;
  std::uint64_t attempt = 0;
  RandomStream stream(const char* purpose) const { return {seed, purpose, 0, attempt}; }
};

struct Task {
  std::vector<Role> fleet;  ///< in fleet order
  double mm_per_pixel = 2.0, duration_s = 600.0;
  double area_m2 = 1000.0;  ///< approximate area of the surfaces to be inspected
};
/// @param blind  no UAV has a LiDAR.
Task draw_task(const Dice& dice, bool blind);

/// A structure at its place: a circle around its footprint, heading, height and mesh.
struct Standing {
  Vector2d p_W = Vector2d::Zero();
  double radius = 0.0, heading = 0.0, height = 0.0;
  TriangleMesh mesh;
};
/// Draws structures whose surfaces to be inspected have about this area [m^2].
std::vector<Standing> draw_structures(const Dice& dice, double area_m2);

/// The UAVs' starts, in fleet order, and the station.
struct Starts {
  std::vector<Vector2d> p_W;
  std::vector<double> yaw;
  Vector3d station_W = Vector3d::Zero();
  TriangleMesh beside;  ///< walls beside the starts or a canopy above them; empty for a blind fleet
};
/// @returns no starts if there is not enough room.
Starts draw_starts(const Dice& dice, const std::vector<VehicleConfig>& fleet, const std::vector<Standing>& structures,
                   const TriangleMesh& mesh, bool blind);

/// Draws the boxes to inspect: one around all structures or some for each; then perhaps one above the starts, and empty
/// ones. @param starts  of the UAVs.
std::vector<OrientedBox> draw_boxes(const Dice& dice, const std::vector<Standing>& structures,
                                    const std::vector<Vector2d>& starts);

/// Trees, cables and poles outside all boxes, clear of starts and station.
TriangleMesh draw_clutter(const Dice& dice, const std::vector<Standing>& structures,
                          const std::vector<OrientedBox>& boxes, const Starts& starts);

/// Whether any vertex lies in a box, or within 0.1 m of it.
bool in_any_box(const TriangleMesh& mesh, const std::vector<OrientedBox>& boxes);

}  // namespace skein::sim::wild
