#include "sim_server/conditions/wind.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/math/normals.hpp"
#include "core/vehicle/rotor_power.hpp"

namespace skein::sim {
namespace {

constexpr double kReferenceHeight_m = 10.0;  ///< of WindConditions::mean_mps
constexpr double kFoot_m = 0.3048;
constexpr double kTwentyFeet_m = 20.0 * kFoot_m;
/// Lower limit of the airspeed: even a UAV that drifts with the wind meets new air, because eddies change.
constexpr double kLeastAirspeed_mps = 1.0;

/// Direction from which the wind blows [rad]: the same for all UAVs of a run.
double direction_from(const WindConditions& wind, std::uint64_t seed) {
  if (wind.from_deg) return *wind.from_deg * kRadPerDeg;
  return RandomStream(seed, "wind_direction", 0).uniform(0.0, 2.0 * std::numbers::pi);
}

Vector3d blown_to(double from) { return {-std::cos(from), -std::sin(from), 0.0}; }

}  // namespace

WindProfile::WindProfile(const WindConditions& wind)
    : mean_mps_(wind.mean_mps),
      roughness_length_m_(wind.roughness_length_m),
      log_reference_(std::log(kReferenceHeight_m / roughness_length_m_)) {
  gusts_.sigma_up_mps = 0.1 * wind.turbulence * mean(kTwentyFeet_m);
}

double WindProfile::mean(double height_m) const {
  return mean_mps_ * std::log(std::max(height_m, roughness_length_m_) / roughness_length_m_) / log_reference_;
}

const GustScales& WindProfile::gusts(double height_m) {
  const double h_ft = std::clamp(height_m / kFoot_m, 10.0, 1000.0);
  if (h_ft == height_ft_) return gusts_;  // a UAV on the ground, say
  height_ft_ = h_ft;
  const double base = 0.177 + 0.000823 * h_ft;
  gusts_.sigma_across_mps = gusts_.sigma_up_mps / std::pow(base, 0.4);
  gusts_.length_across_m = h_ft / std::pow(base, 1.2) * kFoot_m;
  gusts_.length_up_m = h_ft * kFoot_m;
  return gusts_;
}

double LongitudinalGust::keep(double keeps, RandomStream& draw) {
  state_ = keeps * state_ + std::sqrt(1.0 - keeps * keeps) * draw.normal();
  return state_;
}

// With the distance s in lengths L: dx1 = -x1 ds + dW, dx2 = (x1 - x2) ds. The gust is sqrt(3) x1 + (1 - sqrt(3)) x2;
// its transfer function is (1 + sqrt(3) s) / (1 + s)^2. Stationary state: var x1 = 1/2, cov = var x2 = 1/4.
TransverseGust::TransverseGust(RandomStream& draw) : first_(std::sqrt(0.5) * draw.normal()), second_(0.0) {
  second_ = 0.5 * first_ + std::sqrt(0.125) * draw.normal();
}

double TransverseGust::keep(double way, double keeps, RandomStream& draw) {
  const double keeps2 = keeps * keeps;
  const double var_1 = 0.5 * (1.0 - keeps2);
  const double cov = 0.25 * (1.0 - keeps2 * (1.0 + 2.0 * way));
  const double var_2 = 0.25 * (1.0 - keeps2 * (1.0 + 2.0 * way + 2.0 * way * way));
  const double a = std::sqrt(var_1), b = a > 0.0 ? cov / a : 0.0, c = std::sqrt(std::max(0.0, var_2 - b * b));
  const double noise_1 = draw.normal(), noise_2 = draw.normal();
  second_ = keeps * (second_ + way * first_) + b * noise_1 + c * noise_2;
  first_ = keeps * first_ + a * noise_1;
  return std::numbers::sqrt3 * first_ + (1.0 - std::numbers::sqrt3) * second_;
}

Wind::Wind(const WindConditions& wind, std::uint64_t seed, UavIndex uav)
    : wind_(wind),
      profile_(wind),
      draw_(seed, "gusts", uav),
      estimate_draw_(seed, "wind_estimate", uav),
      along_W_(blown_to(direction_from(wind, seed))),
      across_W_(Vector3d::UnitZ().cross(along_W_)),
      u_(draw_),
      v_(draw_),
      w_(draw_),
      error_W_(wind.estimate_sigma_mps * normals(estimate_draw_)) {}

void Wind::step(const Vector3d& p_WB, const Vector3d& v_WB, double step_s, const Vector3d& extra_W) {
  const Vector3d mean_W = profile_.mean(p_WB.z()) * along_W_;
  const GustScales& scales = profile_.gusts(p_WB.z());
  const double way_m = step_s * std::max(kLeastAirspeed_mps, (v_WB - mean_W).norm());
  velocity_W_ = mean_W + extra_W;
  if (scales.sigma_up_mps > 0.0) {
    const double way = way_m / scales.length_across_m, keeps = std::exp(-way);
    const double u = u_.keep(keeps, draw_), v = v_.keep(way, keeps, draw_);
    const double w = w_.step(way_m / scales.length_up_m, draw_);
    velocity_W_ +=
        scales.sigma_across_mps * (u * along_W_ + v * across_W_) + scales.sigma_up_mps * w * Vector3d::UnitZ();
  }
  if (step_s != step_s_) {  // every step is a tick
    step_s_ = step_s;
    keeps_ = std::exp(-step_s / wind_.estimate_time_constant_s);
  }
  lagging_W_ = begun_ ? Vector3d(keeps_ * lagging_W_ + (1.0 - keeps_) * velocity_W_) : velocity_W_;
  begun_ = true;
  error_W_ = keeps_ * error_W_ + wind_.estimate_sigma_mps * std::sqrt(1.0 - keeps_ * keeps_) * normals(estimate_draw_);
}

Vector3d body_drag(double drag_area_m2, const Vector3d& v_A) {
  return -0.5 * kAirDensity * drag_area_m2 * v_A.norm() * v_A;
}

}  // namespace skein::sim
