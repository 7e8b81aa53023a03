#include "sim_server/conditions/path_loss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/normals.hpp"
#include "core/math/random_stream.hpp"

namespace skein::sim {
namespace {

constexpr double kNearest_m = 1.0;  ///< the path-loss law does not hold at shorter distances

}  // namespace

// The spectrum of exp(-r / D) in three dimensions is a Cauchy distribution of wave vectors. To draw from it, divide a
// vector of three standard normal numbers by a fourth one, and by D.
ShadowField::ShadowField(double decorrelation_m, std::uint64_t seed) {
  RandomStream draw(seed, "radio_shadowing", 0);
  for (Wave& wave : waves_) {
    const Vector3d direction = normals(draw);
    double scale = 0.0;
    while (scale == 0.0) scale = std::abs(draw.normal());
    wave.k = direction / (scale * decorrelation_m);
    wave.phase = draw.uniform(0.0, 2.0 * std::numbers::pi);
  }
}

double ShadowField::at(const Vector3d& p_W) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(wave.k.dot(p_W) + wave.phase);
  return std::sqrt(2.0 / static_cast<double>(waves_.size())) * sum;
}

double PathLoss::received_dbm(const Vector3d& p_W, const Vector3d& q_W, double fields) const {
  const double distance_m = std::max(kNearest_m, (p_W - q_W).norm());
  const double shadow_db = radio_.shadowing_sigma_db * fields / std::numbers::sqrt2;
  return radio_.power_dbm - radio_.loss_at_1m_db - 10.0 * *radio_.exponent * std::log10(distance_m) - shadow_db;
}

std::uint8_t PathLoss::level(double received_dbm) {
  std::uint8_t level = 0;
  for (const RadioRate& rate : kRadioRates) level += received_dbm >= rate.least_dbm ? 1 : 0;
  return level;
}

}  // namespace skein::sim
