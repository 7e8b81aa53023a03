// Mass properties and dimensions of a vehicle. It consists of the parts that its file lists: the body, six rotors, and
// links fixed to the body.
// Frame: B body (FLU). Odometry refers to its origin Bo, which in general is not the centre of mass Bcm.  Units: SI.
// Pure; safe from any thread.
#pragma once

#include <array>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein {

inline constexpr std::size_t kRotors = 6;

/// Positions of the rotor hubs in B [m]: rotor i is at 30 + 60 i degrees from body x towards y.
std::array<Vector3d, kRotors> rotor_hubs(const VehicleConfig& vehicle);

struct MassProperties {
  double mass_kg = 0.0;                  ///< total mass
  Vector3d p_BBcm = Vector3d::Zero();    ///< the centre of mass
  Matrix3d I_BBcm_B = Matrix3d::Zero();  ///< inertia about the centre of mass, axes of B [kg m^2]
};

/// Mass properties of all parts together, by the parallel-axis theorem. Rotors are point masses at their hubs.
MassProperties mass_properties(const VehicleConfig& vehicle);

/// A box that can collide and hides what is behind it; its edges are parallel to the axes of B.
struct BodyBox {
  Vector3d p_B = Vector3d::Zero();      ///< its centre
  Vector3d edges_m = Vector3d::Zero();  ///< full lengths
};

/// The boxes of the links, in the file's order; the body's own box is not among them.
std::vector<BodyBox> link_boxes(const VehicleConfig& vehicle);

/// Distance from Bo to the farthest corner of any box, the body's included [m].
double box_reach(const VehicleConfig& vehicle);

/// Height of Bo above the ground when the vehicle rests on its lowest box [m].
double rest_height(const VehicleConfig& vehicle);

/// Radius about the body's z axis that boxes and rotors take up [m].
double body_radius(const VehicleConfig& vehicle);

/// Least horizontal distance between the start positions (Bo) of two UAVs [m]: at any yaw, 2 cm remain between them.
double least_start_distance(const VehicleConfig& a, const VehicleConfig& b);

}  // namespace skein
