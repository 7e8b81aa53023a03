#include "core/vehicle/airframe.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"

namespace skein {
namespace {

constexpr double kStartGap = 0.02;

/// Inertia that a point of mass 1 at p has about the origin.
Matrix3d point_inertia(const Vector3d& p) { return p.squaredNorm() * Matrix3d::Identity() - p * p.transpose(); }

std::vector<BodyBox> all_boxes(const VehicleConfig& vehicle) {
  std::vector<BodyBox> boxes = link_boxes(vehicle);
  boxes.push_back({Vector3d::Zero(), vehicle.collision_box_m});
  return boxes;
}

/// The corner that is farthest from Bo, mirrored into the first octant.
Vector3d farthest_corner(const BodyBox& box) { return box.p_B.cwiseAbs() + 0.5 * box.edges_m; }

}  // namespace

std::array<Vector3d, kRotors> rotor_hubs(const VehicleConfig& vehicle) {
  std::array<Vector3d, kRotors> p_BR;
  for (std::size_t i = 0; i < kRotors; ++i) {
    const double angle = (30.0 + 60.0 * static_cast<double>(i)) * kRadPerDeg;
    p_BR[i] = {vehicle.arm_m * std::cos(angle), vehicle.arm_m * std::sin(angle), vehicle.rotor_height_m};
  }
  return p_BR;
}

MassProperties mass_properties(const VehicleConfig& vehicle) {
  MassProperties whole;
  Vector3d moment = Vector3d::Zero();  // sum of mass times place
  Matrix3d I_BBo_B = Matrix3d::Zero();
  const auto add = [&](double mass, const Vector3d& inertia, const Vector3d& p_B) {
    whole.mass_kg += mass;
    moment += mass * p_B;
    I_BBo_B += Matrix3d(inertia.asDiagonal()) + mass * point_inertia(p_B);
  };
  add(vehicle.mass_kg, vehicle.inertia, Vector3d::Zero());
  for (const Vector3d& p_BR : rotor_hubs(vehicle)) add(vehicle.rotor_mass_kg, Vector3d::Zero(), p_BR);
  for (const VehicleLink& link : vehicle.links) add(link.mass_kg, link.inertia, link.p_BL);
  whole.p_BBcm = moment / whole.mass_kg;
  whole.I_BBcm_B = I_BBo_B - whole.mass_kg * point_inertia(whole.p_BBcm);
  return whole;
}

std::vector<BodyBox> link_boxes(const VehicleConfig& vehicle) {
  std::vector<BodyBox> boxes;
  for (const VehicleLink& link : vehicle.links) {
    if (link.box_m) boxes.push_back({link.p_BL, *link.box_m});
  }
  return boxes;
}

double box_reach(const VehicleConfig& vehicle) {
  double reach = 0.0;
  for (const BodyBox& box : all_boxes(vehicle)) reach = std::max(reach, farthest_corner(box).norm());
  return reach;
}

double rest_height(const VehicleConfig& vehicle) {
  double lowest = 0.0;
  for (const BodyBox& box : all_boxes(vehicle)) lowest = std::min(lowest, box.p_B.z() - 0.5 * box.edges_m.z());
  return -lowest;
}

double body_radius(const VehicleConfig& vehicle) {
  double radius = vehicle.arm_m + vehicle.rotor_radius_m;
  for (const BodyBox& box : all_boxes(vehicle)) radius = std::max(radius, farthest_corner(box).head<2>().norm());
  return radius;
}

double least_start_distance(const VehicleConfig& a, const VehicleConfig& b) {
  return body_radius(a) + body_radius(b) + kStartGap;
}

}  // namespace skein
