// Power of flight by momentum theory: a rotor with disc area A and thrust T accelerates air of density rho by the
// induced velocity v_i. In hover, v_i = v_h = sqrt(T / (2 rho A)). With an air speed V across the disc and a climb
// speed V_c, v_i = v_h^2 / sqrt(V^2 + (V_c + v_i)^2) (Glauert). The ideal power is T (v_i + V_c). One efficiency
// accounts for all other losses (profile drag, motors, motor controllers).
// Source: J. G. Leishman, Principles of Helicopter Aerodynamics, 2nd ed., chapter 2.   Units: SI.   Pure.
#pragma once

#include "core/scenario/conditions.hpp"
#include "core/scenario/scenario.hpp"

namespace skein {

inline constexpr double kAirDensity = 1.225;  ///< at sea level and 15 degrees C [kg/m^3]
inline constexpr double kStandardGravity = 9.8;

/// @param thrust_n  of one rotor, at least 0.  @param across_mps  speed of the air across the disc.
/// @param climb_mps  speed of the disc along its axis through the air; negative: descent.
/// @returns induced velocity [m/s]; 0 without thrust or disc area. For a descent, that of level flight at the same
///   speed across the disc, because momentum theory fails in descents near v_h.
double induced_velocity(double thrust_n, double disc_area_m2, double across_mps, double climb_mps);

/// Ideal power of one rotor [W], not negative.
double ideal_power(double thrust_n, double disc_area_m2, double across_mps, double climb_mps);

/// Electric power with which this vehicle hovers in still air [W].
double hover_power(const VehicleConfig& vehicle, const BatteryConditions& battery);

}  // namespace skein
