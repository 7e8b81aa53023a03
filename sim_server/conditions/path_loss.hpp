// How strong a radio signal arrives, beyond line of sight: log-distance path loss with shadowing that is correlated in
// space and the same both ways.
//
//   received [dBm] = power - loss(1 m) - 10 n log10(d / 1 m) - S,     S = sigma (f(a) + f(b)) / sqrt(2)
//
// f is a standard normal random field whose correlation falls with distance as exp(-|p - q| / D) (Gudmundson 1991),
// made of waves whose numbers are drawn from the spectrum of that correlation. Two places near each other fade alike.
// Frame: W.  Units: SI; dB and dBm where the name says so.  Pure; safe from any thread.
#pragma once

#include <array>
#include <cstdint>

#include "core/conditions.hpp"
#include "core/types.hpp"

namespace skein::sim {

class ShadowField {
 public:
  ShadowField(double decorrelation_m, std::uint64_t seed);
  /// Standard normal over seeds.
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
  /// @param radio  which is on.
  PathLoss(const RadioConditions& radio, std::uint64_t seed) : radio_(radio), field_(radio.decorrelation_m, seed) {}

  /// Between two antennas, without regard to what stands between them.
  double received_dbm(const Vector3d& p_W, const Vector3d& q_W) const;
  /// Place in kRadioRates, counted from 1; 0: too weak for any.
  std::uint8_t level(const Vector3d& p_W, const Vector3d& q_W) const;

 private:
  RadioConditions radio_;
  ShadowField field_;
};

}  // namespace skein::sim
