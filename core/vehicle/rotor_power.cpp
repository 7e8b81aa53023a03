#include "core/vehicle/rotor_power.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vehicle/airframe.hpp"

namespace skein {

double induced_velocity(double thrust_n, double disc_area_m2, double across_mps, double climb_mps) {
  if (thrust_n <= 0.0 || disc_area_m2 <= 0.0) return 0.0;
  const double hover2 = thrust_n / (2.0 * kAirDensity * disc_area_m2);
  const double climb = std::max(climb_mps, 0.0);
  // v sqrt(V^2 + (V_c + v)^2) increases with v, so there is one root. The iteration begins with the induced velocity in
  // hover, which is not below the root. From there Newton's method descends to the root and never passes it.
  double v = std::sqrt(hover2);
  constexpr int kSteps = 8;
  for (int i = 0; i < kSteps; ++i) {
    const double through = climb + v, total = std::hypot(across_mps, through);
    const double before = v;
    v -= (v * total - hover2) / (total + v * through / total);
    if (v == before) break;  // further steps would not change it
  }
  return v;
}

double ideal_power(double thrust_n, double disc_area_m2, double across_mps, double climb_mps) {
  const double through = induced_velocity(thrust_n, disc_area_m2, across_mps, climb_mps) + climb_mps;
  return std::max(0.0, thrust_n * through);
}

double hover_power(const VehicleConfig& vehicle, const BatteryConditions& battery) {
  const double thrust_n = mass_properties(vehicle).mass_kg * kStandardGravity / static_cast<double>(kRotors);
  const double area_m2 = std::numbers::pi * vehicle.rotor_radius_m * vehicle.rotor_radius_m;
  return static_cast<double>(kRotors) * ideal_power(thrust_n, area_m2, 0.0, 0.0) / battery.efficiency +
         battery.avionics_w;
}

}  // namespace skein
