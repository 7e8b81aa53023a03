// Received power of a radio link, which limits links in addition to the line-of-sight rule: log-distance path loss with
// spatially correlated shadowing. It is reciprocal: the same in both directions.
//
//   received [dBm] = power - loss(1 m) - 10 n log10(d / 1 m) - S,     S = sigma (f(a) + f(b)) / sqrt(2)
//
// a and b are the positions of the two antennas, d is their distance (at least 1 m), n the path-loss exponent, S the
// shadowing [dB]. f is a standard normal random field. Its correlation between two positions p and q is
// exp(-|p - q| / D) with the decorrelation distance D (Gudmundson 1991), so nearby positions have similar shadowing.
// The code approximates f by a sum of plane waves whose wave vectors are drawn from the spectrum of that correlation.
// Frame: W.  Units: SI; dB and dBm where the name says so.  Pure; safe from any thread.
#pragma once

#include <array>
#include <cstdint>

#include "core/scenario/conditions.hpp"
#include "core/types.hpp"

namespace skein::sim {

class ShadowField {
 public:
  ShadowField(double decorrelation_m, std::uint64_t seed);
  /// Value of the field at a position. Over all seeds it has, nearly, a standard normal distribution.
  double at(const Vector3d& p_W) const;

 private:
  struct Wave {
    Vector3d k = Vector3d::Zero();  ///< [rad/m]
    double phase = 0.0;
  };
  std::array<Wave, 256> waves_;
};

class PathLoss {
 public:
  /// @param radio  must have path loss: radio.on(). @param seed  draws the shadowing.
  PathLoss(const RadioConditions& radio, std::uint64_t seed) : radio_(radio), field_(radio.decorrelation_m, seed) {}

  /// @param radio  as for the constructor. The shadowing field does not change.
  void change(const RadioConditions& radio) { radio_ = radio; }

  /// Received power [dBm] between antennas at p_W and q_W. Ignores obstacles: LinkTracer checks the line of sight.
  double received_dbm(const Vector3d& p_W, const Vector3d& q_W) const {
    return received_dbm(p_W, q_W, field_at(p_W) + field_at(q_W));
  }
  /// The same for callers that know the field. @param fields  the sum of the field's values at both positions.
  double received_dbm(const Vector3d& p_W, const Vector3d& q_W, double fields) const;
  /// Value of the shadowing field at a position. It costs far more than everything else about a link.
  double field_at(const Vector3d& p_W) const { return field_.at(p_W); }
  /// Index in kRadioRates, counted from 1, of the highest data rate that this received power allows; 0: none.
  static std::uint8_t level(double received_dbm);

 private:
  RadioConditions radio_;
  ShadowField field_;
};

}  // namespace skein::sim
