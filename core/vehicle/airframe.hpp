// A vehicle as a body: what it weighs and where, and how much room it takes. Composed of the parts that its file lists:
// the body, six rotors, and links fixed to the body.
// Frame: B body (FLU); its origin Bo is what odometry speaks of, and in general not the centre of mass Bcm.  Units: SI.
// Pure; safe from any thread.
#pragma once

#include <array>
#include <vector>

#include "core/scenario.hpp"
#include "core/types.hpp"

namespace skein {

inline constexpr std::size_t kRotors = 6;

/// Where the rotors are: rotor i stands at 30 + 60 i degrees from body x towards y.
std::array<Vector3d, kRotors> rotor_hubs(const VehicleConfig& vehicle);

struct MassProperties {
  double mass_kg = 0.0;                  ///< all-up
  Vector3d p_BBcm = Vector3d::Zero();    ///< the centre of mass
  Matrix3d I_BBcm_B = Matrix3d::Zero();  ///< inertia about the centre of mass, axes of B [kg m^2]
};

/// All parts together, by the parallel-axis theorem. Rotors count as points at their hubs.
MassProperties mass_properties(const VehicleConfig& vehicle);

/// A box that collides and hides; its edges are parallel to the axes of B.
struct BodyBox {
  Vector3d p_B = Vector3d::Zero();      ///< its centre
  Vector3d edges_m = Vector3d::Zero();  ///< full lengths
};

/// The boxes of the links, in the file's order; the body's own box is not among them.
std::vector<BodyBox> link_boxes(const VehicleConfig& vehicle);

/// Distance from Bo to the farthest corner of any box, the body's included [m].
double box_reach(const VehicleConfig& vehicle);

/// Height of Bo when the vehicle rests on the ground: on the lowest of its boxes [m].
double rest_height(const VehicleConfig& vehicle);

/// Radius about the body's z axis that boxes and rotors take up [m].
double body_radius(const VehicleConfig& vehicle);

/// How far apart two UAVs must start, centre to centre on the ground: whichever way they are turned, 2 cm remain
/// between them [m].
double least_start_distance(const VehicleConfig& a, const VehicleConfig& b);

}  // namespace skein
