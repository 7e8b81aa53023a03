// The air about one UAV: mean wind with a logarithmic height profile, and Dryden gusts. No wakes: structures neither
// slow the wind nor shed vortices, and two UAVs meet independent gusts however near they are.
//
// Gusts follow MIL-F-8785C's low-altitude model: along the mean wind u, across it v, upwards w, with
//   sigma_w = 0.1 W20,  sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4,
//   L_w = h,  L_u = L_v = h / (0.177 + 0.000823 h)^1.2,      h in feet, within [10, 1000]; W20: the wind at 20 feet.
// Their spectra are over distance, and the UAV flies through them with its own airspeed (Taylor's hypothesis).
// Frame: W world (ENU).  Units: SI.  Threads: one.  The same seed and flight give the same bits.
#pragma once

#include "core/conditions.hpp"
#include "core/random_stream.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// Mean wind at a height by the logarithmic law; none at the roughness length and below [m/s].
double mean_wind(const WindConditions& wind, double height_m);

/// Deviations and lengths of the gusts at a height.
struct GustScales {
  double sigma_across_mps = 0.0, sigma_up_mps = 0.0;  ///< `across`: along the wind, too
  double length_across_m = 0.0, length_up_m = 0.0;
};
GustScales gust_scales(const WindConditions& wind, double height_m);

/// Spectrum 1 / (1 + (L Omega)^2), of unit variance.
class LongitudinalGust {
 public:
  /// Draws the stationary state.
  explicit LongitudinalGust(RandomStream& draw) : state_(draw.normal()) {}
  /// @param way  that the UAV flew through the air, in lengths L.
  double step(double way, RandomStream& draw);

 private:
  double state_;
};

/// Spectrum (1 + 3 (L Omega)^2) / (1 + (L Omega)^2)^2, of unit variance.
class TransverseGust {
 public:
  explicit TransverseGust(RandomStream& draw);
  double step(double way, RandomStream& draw);

 private:
  double first_, second_;  ///< white noise behind one lag, and behind two
};

class Wind {
 public:
  /// @param wind  with a mean above 0. @param uav  keys the gusts; the direction is the same for all.
  Wind(const WindConditions& wind, std::uint64_t seed, UavIndex uav);

  /// @param wind  for the steps that follow; the direction and the gusts' state stay.
  void change(const WindConditions& wind) { wind_ = wind; }
  /// The air about a UAV, a time step later. @param extra_W  that a fault adds.
  void step(const Vector3d& p_WB, const Vector3d& v_WB, double step_s, const Vector3d& extra_W = Vector3d::Zero());

  const Vector3d& velocity_W() const { return velocity_W_; }
  /// What the UAV is told of it: late, and off by a Gauss-Markov error.
  Vector3d estimate_W() const { return lagging_W_ + error_W_; }
  /// Where the mean wind blows to: a horizontal unit vector.
  const Vector3d& along_W() const { return along_W_; }

 private:
  WindConditions wind_;
  RandomStream draw_, estimate_draw_;
  Vector3d along_W_, across_W_;
  LongitudinalGust u_;
  TransverseGust v_, w_;
  Vector3d velocity_W_ = Vector3d::Zero(), lagging_W_ = Vector3d::Zero(), error_W_ = Vector3d::Zero();
  bool begun_ = false;
};

/// Drag of a body, without its rotors, in air that moves about it [N]. @param v_A  of the body through the air.
Vector3d body_drag(double drag_area_m2, const Vector3d& v_A);

}  // namespace skein::sim
