#include "sim_server/conditions/path_loss.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/random_stream.hpp"

namespace skein::sim {
namespace {

TEST(ShadowField, TheFieldIsStandardNormalAndItsCorrelationFallsExponentially) {
  constexpr double kDecorrelation_m = 15.0;
  constexpr int kFields = 4000;
  for (const double apart_m : {0.0, 5.0, 15.0, 45.0}) {
    double sum = 0.0, mean = 0.0;
    for (std::uint64_t seed = 1; seed <= kFields; ++seed) {
      const ShadowField field(kDecorrelation_m, seed);
      const Vector3d p_W(30, -20, 12), q_W = p_W + apart_m * Vector3d(0.6, 0.0, 0.8);
      sum += field.at(p_W) * field.at(q_W);
      mean += field.at(p_W);
    }
    EXPECT_NEAR(mean / kFields, 0.0, 0.07);
    EXPECT_NEAR(sum / kFields, std::exp(-apart_m / kDecorrelation_m), 0.09) << apart_m;
  }
}

TEST(PathLoss, TheReceivedPowerFollowsTheLogDistanceLawWithShadowing) {
  RadioConditions radio = conditions_preset("harsh").radio;
  RandomStream draw(1, "path_loss_test", 0);
  double sum = 0.0, squares = 0.0;
  constexpr int kSamples = 4000;
  for (std::uint64_t seed = 1; seed <= kSamples; ++seed) {
    const PathLoss loss(radio, seed);
    const Vector3d p_W(draw.uniform(-50, 50), 0, 10), q_W(draw.uniform(300, 400), 80, 30);
    const double law = radio.power_dbm - radio.loss_at_1m_db - 10.0 * *radio.exponent * std::log10((p_W - q_W).norm());
    const double off = loss.received_dbm(p_W, q_W) - law;
    sum += off;
    squares += off * off;
    EXPECT_EQ(loss.received_dbm(p_W, q_W), loss.received_dbm(q_W, p_W)) << "the same both ways";
  }
  const double sigma = radio.shadowing_sigma_db;
  EXPECT_NEAR(sum / kSamples, 0.0, 0.08 * sigma);
  EXPECT_NEAR(squares / kSamples, sigma * sigma, 0.12 * sigma * sigma) << "far ends fade independently";
}

TEST(PathLoss, TheRateLevelFallsWithDistanceToZero) {
  RadioConditions radio = conditions_preset("harsh").radio;
  radio.shadowing_sigma_db = 0.0;
  const PathLoss loss(radio, 1);
  std::uint8_t before = static_cast<std::uint8_t>(kRadioRates.size());
  EXPECT_EQ(PathLoss::level(loss.received_dbm({0, 0, 10}, {2, 0, 10})), before);
  for (double distance_m = 2.0; distance_m < 1e5; distance_m *= 1.1) {
    const std::uint8_t level = PathLoss::level(loss.received_dbm({0, 0, 10}, {distance_m, 0, 10}));
    EXPECT_LE(level, before);
    before = level;
  }
  EXPECT_EQ(before, 0);
}

}  // namespace
}  // namespace skein::sim
