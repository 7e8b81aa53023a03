// Compares the wind with its formulas, over long samples.
#include "sim_server/conditions/wind.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace skein::sim {
namespace {

/// One sample every `way` lengths.
std::vector<double> sampled(bool transverse, double way, std::size_t count) {
  RandomStream draw(7, "gust_test", transverse ? 1 : 0);
  LongitudinalGust u(draw);
  TransverseGust v(draw);
  std::vector<double> samples(count);
  for (double& sample : samples) sample = transverse ? v.step(way, draw) : u.step(way, draw);
  return samples;
}

double correlation(const std::vector<double>& x, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = lag; i < x.size(); ++i) sum += x[i] * x[i - lag];
  return sum / static_cast<double>(x.size() - lag);
}

/// Two-sided power density over Omega [1/length], the mean over windows of the sample (Hann).
double power_density(const std::vector<double>& x, double way, double omega) {
  constexpr std::size_t kWindow = 4000;
  double sum = 0.0, taper2 = 0.0;
  std::size_t windows = 0;
  for (std::size_t begin = 0; begin + kWindow <= x.size(); begin += kWindow, ++windows) {
    std::complex<double> amplitude = 0.0;
    taper2 = 0.0;
    for (std::size_t i = 0; i < kWindow; ++i) {
      const double taper = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / kWindow);
      taper2 += taper * taper;
      amplitude += taper * x[begin + i] * std::polar(1.0, -omega * way * static_cast<double>(i));
    }
    sum += std::norm(amplitude);
  }
  return sum * way / taper2 / static_cast<double>(windows);
}

TEST(Gusts, GustsHaveDrydensCorrelationsAndUnitVarianceWithAnyStep) {
  for (const double way : {0.02, 0.1, 0.5}) {
    const std::vector<double> u = sampled(false, way, 600'000), v = sampled(true, way, 600'000);
    const double tolerance = 4.0 * std::sqrt(2.0 / (way * 600'000.0));
    for (const double distance : {0.0, 0.5, 1.0, 2.0, 4.0}) {
      const auto lag = static_cast<std::size_t>(std::lround(distance / way));
      EXPECT_NEAR(correlation(u, lag), std::exp(-distance), tolerance) << way << ", " << distance;
      EXPECT_NEAR(correlation(v, lag), std::exp(-distance) * (1.0 - 0.5 * distance), tolerance)
          << way << ", " << distance;
    }
  }
}

TEST(Gusts, GustsHaveDrydensSpectra) {
  constexpr double kWay = 0.05;
  const std::vector<double> u = sampled(false, kWay, 2'000'000), v = sampled(true, kWay, 2'000'000);
  for (const double omega : {0.3, 1.0, 2.0, 5.0, 10.0}) {  // of unit variance and length
    const double one = 1.0 + omega * omega;
    const double longitudinal = 2.0 / one, transverse = (1.0 + 3.0 * omega * omega) / (one * one);
    EXPECT_NEAR(power_density(u, kWay, omega), longitudinal, 0.15 * longitudinal) << omega;
    EXPECT_NEAR(power_density(v, kWay, omega), transverse, 0.15 * transverse) << omega;
  }
}

TEST(MeanWind, TheMeanWindFollowsTheLogarithmicLaw) {
  const WindConditions wind{.mean_mps = 8.0, .from_deg = {}, .roughness_length_m = 0.1};
  EXPECT_DOUBLE_EQ(WindProfile(wind).mean(10.0), 8.0);
  EXPECT_NEAR(WindProfile(wind).mean(40.0) - WindProfile(wind).mean(20.0), 8.0 * std::log(2.0) / std::log(100.0),
              1e-12);
  EXPECT_EQ(WindProfile(wind).mean(0.1), 0.0);
  EXPECT_EQ(WindProfile(wind).mean(-3.0), 0.0);
}

TEST(GustScales, TheScalesAreThoseOfMilF8785C) {
  const WindConditions wind{.mean_mps = 10.0, .from_deg = {}, .turbulence = 1.0};
  const double w20 = WindProfile(wind).mean(6.096);
  // At 1000 feet the base is 1: all deviations and lengths agree.
  const GustScales high = WindProfile(wind).gusts(304.8);
  EXPECT_NEAR(high.sigma_up_mps, 0.1 * w20, 1e-12);
  EXPECT_NEAR(high.sigma_across_mps, 0.1 * w20, 1e-3);
  EXPECT_NEAR(high.length_across_m, 304.8, 0.5);
  EXPECT_NEAR(high.length_up_m, 304.8, 1e-9);
  // At 100 feet: 0.2593^-0.4 = 1.716, 100 / 0.2593^1.2 = 505 feet.
  const GustScales low = WindProfile(wind).gusts(30.48);
  EXPECT_NEAR(low.sigma_across_mps / low.sigma_up_mps, 1.716, 2e-3);
  EXPECT_NEAR(low.length_across_m, 505.1 * 0.3048, 0.5);
  EXPECT_EQ(WindProfile({.mean_mps = 10.0, .from_deg = {}, .turbulence = 0.0}).gusts(30.0).sigma_across_mps, 0.0);
}

struct Moments {
  Vector3d mean = Vector3d::Zero(), variance = Vector3d::Zero();  ///< along the wind, across, up
};

Moments moments(const WindConditions& conditions, double height_m, const Vector3d& v_WB,
                const std::function<Vector3d(const Wind&)>& value) {
  constexpr int kSteps = 400'000;
  Wind wind(conditions, 3, UavIndex{1});
  Moments sum;
  for (int i = 0; i < kSteps; ++i) {
    wind.step({0.0, 0.0, height_m}, v_WB, 0.05);
    const Vector3d velocity_W = value(wind);
    const Vector3d across_W = Vector3d::UnitZ().cross(wind.along_W());
    const Vector3d v(velocity_W.dot(wind.along_W()), velocity_W.dot(across_W), velocity_W.z());
    sum.mean += v / kSteps;
    sum.variance += v.cwiseAbs2() / kSteps;
  }
  sum.variance -= sum.mean.cwiseAbs2();
  return sum;
}

TEST(Wind, TheWindHasItsMeanAndVariancesForHoveringAndForFlyingUavs) {
  const WindConditions conditions{.mean_mps = 7.0, .from_deg = {}, .turbulence = 1.5};
  for (const Vector3d& v_WB : {Vector3d(0, 0, 0), Vector3d(4, -2, 1)}) {
    for (const double height_m : {8.0, 40.0}) {
      const GustScales scales = WindProfile(conditions).gusts(height_m);
      const Moments m = moments(conditions, height_m, v_WB, [](const Wind& wind) { return wind.velocity_W(); });
      EXPECT_NEAR(m.mean.x(), WindProfile(conditions).mean(height_m), 0.15 * scales.sigma_across_mps);
      EXPECT_NEAR(m.mean.y(), 0.0, 0.15 * scales.sigma_across_mps);
      EXPECT_NEAR(m.mean.z(), 0.0, 0.1 * scales.sigma_up_mps);
      const double across2 = scales.sigma_across_mps * scales.sigma_across_mps;
      EXPECT_NEAR(m.variance.x(), across2, 0.15 * across2);
      EXPECT_NEAR(m.variance.y(), across2, 0.15 * across2);
      EXPECT_NEAR(m.variance.z(), scales.sigma_up_mps * scales.sigma_up_mps,
                  0.1 * scales.sigma_up_mps * scales.sigma_up_mps);
    }
  }
}

/// WindProfile computes each part once, and again only if the height has changed. Digests require the same bits.
TEST(Wind, TheProfileIsThatOfTheFormulasBitForBit) {
  RandomStream draw(5, "wind_test", 0);
  for (int i = 0; i < 50; ++i) {
    const WindConditions wind{.mean_mps = draw.uniform(0.1, 25.0),
                              .from_deg = {},
                              .roughness_length_m = draw.uniform(0.0001, 2.0),
                              .turbulence = draw.uniform(0.0, 4.0)};
    const auto mean = [&](double height_m) {
      const double z0_m = wind.roughness_length_m;
      return wind.mean_mps * std::log(std::max(height_m, z0_m) / z0_m) / std::log(10.0 / z0_m);
    };
    WindProfile profile(wind);
    double height_m = 0.0;
    for (int step = 0; step < 100; ++step) {
      if (draw.uniform() < 0.7) height_m = draw.uniform(-1.0, step % 2 == 0 ? 5.0 : 400.0);
      EXPECT_EQ(profile.mean(height_m), mean(height_m));
      const double h_ft = std::clamp(height_m / 0.3048, 10.0, 1000.0), base = 0.177 + 0.000823 * h_ft;
      const double sigma_up = 0.1 * wind.turbulence * mean(20.0 * 0.3048);
      const GustScales scales = profile.gusts(height_m);
      EXPECT_EQ(scales.sigma_up_mps, sigma_up);
      EXPECT_EQ(scales.sigma_across_mps, sigma_up / std::pow(base, 0.4));
      EXPECT_EQ(scales.length_across_m, h_ft / std::pow(base, 1.2) * 0.3048);
      EXPECT_EQ(scales.length_up_m, h_ft * 0.3048);
    }
  }
}

TEST(Wind, AfterAChangeTheWindFollowsItsNewConditions) {
  const WindConditions before{.mean_mps = 5.0, .from_deg = {}, .turbulence = 1.0, .estimate_sigma_mps = 0.0};
  WindConditions after = before;
  after.turbulence = 2.5;  // unlike another mean, it leaves the first step of the gusts as it is
  after.estimate_time_constant_s = 0.3;
  Wind changed(before, 4, UavIndex{0}), expected(before, 4, UavIndex{0});
  changed.step({0, 0, 20}, Vector3d::Zero(), 0.05);
  expected.change(after);
  expected.step({0, 0, 20}, Vector3d::Zero(), 0.05);
  changed.change(after);
  const Vector3d lag_W = changed.estimate_W() - expected.estimate_W();
  for (int i = 1; i <= 10; ++i) {
    for (Wind* wind : {&changed, &expected}) wind->step({0, 0, 20}, Vector3d::Zero(), 0.05);
    EXPECT_EQ(changed.velocity_W(), expected.velocity_W());
    const Vector3d off_W = changed.estimate_W() - expected.estimate_W();
    EXPECT_LT((off_W - std::exp(-i * 0.05 / 0.3) * lag_W).norm(), 1e-12)
        << "the estimate lags with the new time constant";
  }
}

TEST(Wind, TheEstimateOfTheWindHasItsOwnError) {
  const WindConditions conditions{.mean_mps = 5.0, .from_deg = {}, .turbulence = 0.0, .estimate_sigma_mps = 0.5};
  const Moments m = moments(conditions, 10.0, Vector3d::Zero(), [](const Wind& wind) { return wind.estimate_W(); });
  EXPECT_NEAR(m.mean.x(), 5.0, 0.03);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(m.variance[axis], 0.25, 0.02);
}

TEST(Wind, TheSameSeedGivesTheSameWindAndOneDirectionForAllUavs) {
  const WindConditions conditions{.mean_mps = 5.0, .from_deg = {}, .turbulence = 1.0};
  Wind one(conditions, 4, UavIndex{0}), same(conditions, 4, UavIndex{0}), other(conditions, 4, UavIndex{1});
  Wind another_run(conditions, 5, UavIndex{0});
  for (int i = 0; i < 100; ++i) {
    for (Wind* wind : {&one, &same, &other, &another_run}) wind->step({0, 0, 20}, Vector3d::Zero(), 0.05);
  }
  EXPECT_EQ(one.velocity_W(), same.velocity_W());
  EXPECT_EQ(one.along_W(), other.along_W());
  EXPECT_NE(one.velocity_W(), other.velocity_W());
  EXPECT_NE(one.along_W(), another_run.along_W());
  Wind north({.mean_mps = 5.0, .from_deg = 90.0}, 4, UavIndex{0});
  EXPECT_LT((north.along_W() - Vector3d(0, -1, 0)).norm(), 1e-12) << "from the north";
  north.step({0, 0, 10}, Vector3d::Zero(), 0.05, {0, 0, 3});
  EXPECT_LT((north.velocity_W() - Vector3d(0, -5, 3)).norm(), 1e-12) << "with what a fault adds";
}

TEST(BodyDrag, TheDragOpposesTheAirspeedAndGrowsWithItsSquare) {
  EXPECT_LT((body_drag(0.03, {10, 0, 0}) - Vector3d(-0.5 * 1.225 * 0.03 * 100.0, 0, 0)).norm(), 1e-12);
  EXPECT_LT((body_drag(0.03, {0, -20, 0}) + 4.0 * body_drag(0.03, {0, 10, 0})).norm(), 1e-12);
}

}  // namespace
}  // namespace skein::sim
