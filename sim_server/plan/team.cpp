#include "sim_server/plan/team.hpp"

#include <algorithm>
#include <cmath>

#include "sight/ray_shapes.hpp"

namespace skein::sim {
namespace {

constexpr double kMostDownwards = 1.5;  ///< limit of the vertical acceleration [m/s^2]

bool alike(const TeamKind& a, const TeamKind& b) {
  return a.camera.essence() == b.camera.essence() && a.speed == b.speed && a.acceleration == b.acceleration &&
         a.vehicle.antenna_offset_m == b.vehicle.antenna_offset_m &&
         a.vehicle.gimbal.rate_limit_deg_s == b.vehicle.gimbal.rate_limit_deg_s;
}

}  // namespace

double TeamKind::acceleration_along(const Vector3d& way) const {
  const double length = way.norm(), steepness = length > 0.0 ? std::abs(way.z()) / length : 0.0;
  return steepness * acceleration > kMostDownwards ? kMostDownwards / steepness : acceleration;
}

double TeamKind::travel_s(const Vector3d& way) const {
  const double distance = way.norm(), a = acceleration_along(way), ramps = speed * speed / a;  // both ramps
  return distance >= ramps ? distance / speed + speed / a : 2.0 * std::sqrt(distance / a);
}

TeamKind::Motion TeamKind::motion(const Vector3d& way, double t) const {
  const double length = way.norm(), a = acceleration_along(way), total = travel_s(way);
  const double top = std::min(speed, std::sqrt(length * a)), ramp_s = top / a;
  if (t <= 0.0) return {0.0, 0.0, 0.0};
  if (t >= total) return {length, 0.0, 0.0};
  if (t < ramp_s) return {0.5 * a * t * t, a * t, a};
  const double left = total - t;
  if (left < ramp_s) return {length - 0.5 * a * left * left, a * left, -a};
  return {0.5 * a * ramp_s * ramp_s + top * (t - ramp_s), top, 0.0};
}

Team::Team(const Scenario& scenario, const PlanConfig& config) {
  for (const UavConfig& uav : scenario.fleet) {
    const VehicleConfig& vehicle = uav.vehicle;
    const BodyShape shape = body_shape(vehicle);
    const TeamKind kind{vehicle,
                        {vehicle.camera, vehicle.gimbal, shape},
                        shape,
                        Body(shape).radius + config.margin_m,
                        config.speed_share * vehicle.max_speed_mps,
                        config.acceleration_share * vehicle.max_acceleration_mps2};
    const auto known = std::ranges::find_if(kinds, [&](const TeamKind& other) { return alike(other, kind); });
    kind_of.push_back(static_cast<std::size_t>(known - kinds.begin()));
    if (known == kinds.end()) kinds.push_back(kind);
  }
}

}  // namespace skein::sim
