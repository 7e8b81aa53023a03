// The wind at one UAV: a mean wind with a logarithmic height profile, and Dryden gusts. The model has no wakes:
// structures neither slow the wind nor shed vortices. Gusts of two UAVs are independent, however close the UAVs are.
//
// Gusts follow MIL-F-8785C's low-altitude model: u along the mean wind, v across it, w upwards, with
//   sigma_w = 0.1 W20,  sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4,
//   L_w = h,  L_u = L_v = h / (0.177 + 0.000823 h)^1.2,      h in feet, within [10, 1000]; W20: the wind at 20 feet.
// The spectra are over distance: the gusts are frozen in the air, and the UAV flies through them at its airspeed
// (Taylor's hypothesis).
// Frame: W world (ENU).  Units: SI.  Threads: one.  The same seed and flight give the same bits.
#pragma once

#include <cmath>
#include <optional>

#include "core/math/random_stream.hpp"
#include "core/scenario/conditions.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// Standard deviations and length scales of the gusts at a height.
struct GustScales {
  double sigma_across_mps = 0.0, sigma_up_mps = 0.0;  ///< `across`: v and also u
  double length_across_m = 0.0, length_up_m = 0.0;
};

/// A wind at many heights: computes only once what does not depend on the height.
class WindProfile {
 public:
  explicit WindProfile(const WindConditions& wind);
  /// Mean wind speed at a height by the logarithmic law [m/s]; 0 at the roughness length and below.
  double mean(double height_m) const;
  const GustScales& gusts(double height_m);

 private:
  double mean_mps_, roughness_length_m_, log_reference_;
  double height_ft_ = 0.0;  ///< of `gusts_`
  GustScales gusts_;
};

/// The gust u: spectrum 1 / (1 + (L Omega)^2), scaled to unit variance.
class LongitudinalGust {
 public:
  /// Draws the stationary state.
  explicit LongitudinalGust(RandomStream& draw) : state_(draw.normal()) {}
  /// @param way  distance that the UAV flew through the air, in lengths L. @returns the gust.
  double step(double way, RandomStream& draw) { return keep(std::exp(-way), draw); }
  /// The same for callers that know exp(-way).
  double keep(double keeps, RandomStream& draw);

 private:
  double state_;
};

/// The gusts v and w: spectrum (1 + 3 (L Omega)^2) / (1 + (L Omega)^2)^2, scaled to unit variance.
class TransverseGust {
 public:
  explicit TransverseGust(RandomStream& draw);
  double step(double way, RandomStream& draw) { return keep(way, std::exp(-way), draw); }
  double keep(double way, double keeps, RandomStream& draw);

 private:
  double first_, second_;  ///< white noise after one first-order lag, and after two
};

class Wind {
 public:
  /// @param wind  with a mean above 0. @param uav  keys the gusts; the wind's direction is the same for all UAVs.
  Wind(const WindConditions& wind, std::uint64_t seed, UavIndex uav);

  /// @param wind  for the steps that follow. Direction and state of the gusts do not change.
  void change(const WindConditions& wind) {
    wind_ = wind;
    profile_ = WindProfile(wind);
    step_s_.reset();  // computes `keeps_` anew
  }
  /// Advances the wind by one time step. @param p_WB, v_WB  of the UAV. @param extra_W  wind that a fault adds.
  void step(const Vector3d& p_WB, const Vector3d& v_WB, double step_s, const Vector3d& extra_W = Vector3d::Zero());

  /// Velocity of the air at the UAV [m/s].
  const Vector3d& velocity_W() const { return velocity_W_; }
  /// The UAV's estimate of velocity_W(): low-pass filtered, and with a Gauss-Markov error [m/s].
  Vector3d estimate_W() const { return lagging_W_ + error_W_; }
  /// Direction in which the mean wind blows: a horizontal unit vector. For tests, which separate the gusts along it
  /// from those across it.
  const Vector3d& along_W() const { return along_W_; }

 private:
  WindConditions wind_;
  WindProfile profile_;
  RandomStream draw_, estimate_draw_;
  Vector3d along_W_, across_W_;
  LongitudinalGust u_;
  TransverseGust v_, w_;
  Vector3d velocity_W_ = Vector3d::Zero(), lagging_W_ = Vector3d::Zero(), error_W_ = Vector3d::Zero();
  bool begun_ = false;
  std::optional<double> step_s_;  ///< the last step
  double keeps_ = 1.0;            ///< share of its deviation that the estimate keeps in such a step
};

/// Drag of a body without its rotors [N], in the frame of `v_A`. @param v_A  velocity of the body through the air.
Vector3d body_drag(double drag_area_m2, const Vector3d& v_A);

}  // namespace skein::sim
