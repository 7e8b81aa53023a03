// The odometry's error compared with its formulas, over long samples, and its stated variance with the actual errors.
#include "sim_server/conditions/odometry_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

constexpr double kStep_s = 0.05;
const Quaterniond kTilted(Matrix3d(rotation_z(1.3) * rotation_y(-0.2)));

TEST(OdometryError, TheErrorIsAGaussMarkovProcessOfItsDeviationAndTimeConstant) {
  const OdometryConditions config{.horizontal_sigma_m = 0.3,
                                  .vertical_sigma_m = 0.6,
                                  .time_constant_s = 5.0,
                                  .yaw_sigma_deg = 2.0,
                                  .yaw_time_constant_s = 8.0,
                                  .mean_fix_s = {}};
  OdometryError error(config, 1, UavIndex{0});
  constexpr std::size_t kSteps = 1'000'000;
  std::vector<double> x(kSteps), z(kSteps), yaw(kSteps);
  for (std::size_t i = 0; i < kSteps; ++i) {
    error.step(kStep_s);
    x[i] = error.position_error_m().x();
    z[i] = error.position_error_m().z();
    yaw[i] = error.yaw_error();
  }
  const auto correlation = [](const std::vector<double>& values, double lag_s) {
    const auto lag = static_cast<std::size_t>(std::lround(lag_s / kStep_s));
    double sum = 0.0;
    for (std::size_t i = lag; i < values.size(); ++i) sum += values[i] * values[i - lag];
    return sum / static_cast<double>(values.size() - lag);
  };
  const double yaw2 = std::pow(2.0 * kRadPerDeg, 2);
  for (const double lag_s : {0.0, 2.0, 5.0, 15.0}) {
    EXPECT_NEAR(correlation(x, lag_s) / 0.09, std::exp(-lag_s / 5.0), 0.06) << lag_s;
    EXPECT_NEAR(correlation(z, lag_s) / 0.36, std::exp(-lag_s / 5.0), 0.06) << lag_s;
    EXPECT_NEAR(correlation(yaw, lag_s) / yaw2, std::exp(-lag_s / 8.0), 0.07) << lag_s;
  }
}

/// believed() uses a rotation that is computed when the error changes.
TEST(OdometryError, TheBelievedAttitudeIsTurnedByTheYawErrorBitForBit) {
  OdometryConditions config{.yaw_sigma_deg = 3.0, .yaw_time_constant_s = 2.0, .mean_fix_s = {}};
  OdometryError error(config, 3, UavIndex{1});
  RigidBodyState truth;
  truth.q_WB = kTilted;
  const auto expect_turned = [&] {
    const Quaterniond turned = Eigen::AngleAxisd(error.yaw_error(), Vector3d::UnitZ()) * kTilted;
    EXPECT_EQ(error.believed(truth).q_WB.coeffs(), turned.coeffs());
    EXPECT_EQ(error.told(truth).q_WB.coeffs(), turned.coeffs());
  };
  expect_turned();
  for (int i = 0; i < 200; ++i) {
    error.step(kStep_s);
    expect_turned();
  }
  config.yaw_sigma_deg = 1.0;
  error.change(config);
  expect_turned();
}

TEST(OdometryError, TheErrorIsZeroAtAKnownStartAndThenGrowsToItsDeviation) {
  constexpr std::uint64_t kSeeds = 4000;
  const OdometryConditions config{.horizontal_sigma_m = 0.3,
                                  .vertical_sigma_m = 0.6,
                                  .time_constant_s = 20.0,
                                  .yaw_sigma_deg = 2.0,
                                  .mean_fix_s = {},
                                  .known_start = true};
  for (const double flown_s : {1.0, 5.0, 20.0, 60.0}) {
    double horizontal2 = 0.0, vertical2 = 0.0;
    Vector3d told_m = Vector3d::Zero();
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      OdometryError error(config, seed, UavIndex{seed % 5});
      const double waits_s = 30.0 * RandomStream(seed, "start_test", 0).uniform();
      for (double t = 0.0; t < waits_s; t += kStep_s) error.step(kStep_s);
      ASSERT_EQ(error.position_error_m(), Vector3d::Zero()) << "the UAV has not taken off";
      ASSERT_EQ(error.uncertainty().position_m, Vector3d::Zero());
      ASSERT_NE(error.yaw_error(), 0.0) << "the heading at the start is not known exactly";
      error.leave_start();
      for (double t = 0.0; t < flown_s - kStep_s / 2; t += kStep_s) error.step(kStep_s);
      horizontal2 += std::pow(error.position_error_m().x(), 2);
      vertical2 += std::pow(error.position_error_m().z(), 2);
      told_m = error.uncertainty().position_m;
    }
    const double share = 1.0 - std::exp(-2.0 * flown_s / 20.0);
    const double tolerance = 4.0 * std::sqrt(2.0 / kSeeds);
    EXPECT_NEAR(horizontal2 / kSeeds / (0.09 * share), 1.0, tolerance) << flown_s;
    EXPECT_NEAR(vertical2 / kSeeds / (0.36 * share), 1.0, tolerance) << flown_s;
    EXPECT_NEAR(told_m.x(), 0.3 * std::sqrt(share), 1e-9) << flown_s;
    EXPECT_NEAR(told_m.z(), 0.6 * std::sqrt(share), 1e-9) << flown_s;
  }
}

/// Normalised estimation errors squared, of position, yaw and velocity. Their mean is 1 per degree of freedom if the
/// odometry states its covariance correctly.
struct Nees {
  double position = 0.0, yaw = 0.0, velocity = 0.0;
  std::size_t samples = 0, without_fix = 0;
};

/// @param disturb  called before each step with the time and a draw of the flight's own.
Nees nees(const OdometryConditions& config, bool only_without_fix = false,
          const std::function<void(OdometryError&, double, double)>& disturb = {}) {
  constexpr std::uint64_t kSeeds = 4000;
  constexpr double kDuration_s = 40.0;
  const RigidBodyState truth{.p_WB = {3, -4, 20}, .q_WB = kTilted, .v_WB = {1, 2, 0}};
  Nees sum;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    OdometryError error(config, seed, UavIndex{seed % 5});
    RandomStream draw(seed, "nees_test", 0);
    const double until_s = kDuration_s * draw.uniform(), leaves_s = 0.3 * kDuration_s * draw.uniform();
    const double own = draw.uniform();
    for (double t = 0.0; t < until_s; t += kStep_s) {
      if (t >= leaves_s) error.leave_start();
      if (disturb) disturb(error, t, own);
      error.step(kStep_s);
    }
    error.draw_noise();
    sum.without_fix += error.has_fix() ? 0 : 1;
    if (only_without_fix && error.has_fix()) continue;
    const RigidBodyState told = error.told(truth);
    const PoseUncertainty sigma = error.uncertainty();
    sum.position += (told.p_WB - truth.p_WB).cwiseQuotient(sigma.position_m).squaredNorm();
    const Eigen::AngleAxisd turn(told.q_WB * truth.q_WB.conjugate());
    sum.yaw += std::pow(turn.angle() * turn.axis().z() / sigma.yaw, 2);
    sum.velocity += ((told.v_WB - truth.v_WB) / sigma.velocity_mps).squaredNorm();
    ++sum.samples;
  }
  const auto n = static_cast<double>(sum.samples);
  sum.position /= n;
  sum.yaw /= n;
  sum.velocity /= n;
  return sum;
}

/// Four deviations of the mean of n sums of squares of `dof` normal numbers.
double tolerance(double dof, std::size_t n) { return 4.0 * std::sqrt(2.0 * dof / static_cast<double>(n)); }

TEST(OdometryError, TheStatedCovarianceIsConsistentWithTheActualErrors) {
  for (const char* preset : {"breezy", "harsh"}) {
    OdometryConditions config = conditions_preset(preset).odometry;
    const Nees all = nees(config);
    EXPECT_NEAR(all.position, 3.0, tolerance(3.0, all.samples)) << preset;
    EXPECT_NEAR(all.yaw, 1.0, tolerance(1.0, all.samples)) << preset;
    EXPECT_NEAR(all.velocity, 3.0, tolerance(3.0, all.samples)) << preset;
  }
}

TEST(OdometryError, TheStatedCovarianceIsConsistentWithoutAFixToo) {
  OdometryConditions config = conditions_preset("harsh").odometry;
  config.mean_fix_s = 10.0;
  config.mean_lost_s = 10.0;
  config.walk_m_per_sqrt_s = 0.3;
  const Nees lost = nees(config, true);
  ASSERT_GT(lost.samples, 1000U) << "of 4000 flights, about half have no fix";
  EXPECT_NEAR(lost.position, 3.0, tolerance(3.0, lost.samples));
}

TEST(OdometryError, TheStatedCovarianceIsConsistentWhenTheFixIsJammedAndConditionsChange) {
  OdometryConditions config = conditions_preset("harsh").odometry, worse = config;
  config.mean_fix_s = 10.0;
  worse.horizontal_sigma_m *= 3.0;
  worse.walk_m_per_sqrt_s *= 2.0;
  worse.noise_sigma_m *= 4.0;
  const auto disturb = [&](OdometryError& error, double t, double own) {
    const double begin_s = 20.0 * own;
    error.jam(t > begin_s && t < begin_s + 12.0);
    if (std::abs(t - begin_s - 5.0) < kStep_s / 2) error.change(worse);
    if (std::abs(t - begin_s - 9.0) < kStep_s / 2) error.change(config);
  };
  const Nees all = nees(config, false, disturb), lost = nees(config, true, disturb);
  EXPECT_NEAR(all.position, 3.0, tolerance(3.0, all.samples));
  ASSERT_GT(lost.samples, 1000U);
  EXPECT_NEAR(lost.position, 3.0, tolerance(3.0, lost.samples));
}

TEST(OdometryError, ThePositionErrorWalksOffWithoutAFixAndJumpsBackWithOne) {
  OdometryConditions config{
      .horizontal_sigma_m = 0.1, .vertical_sigma_m = 0.1, .time_constant_s = 1e4, .mean_fix_s = {}};
  config.mean_fix_s = 20.0;
  config.mean_lost_s = 60.0;
  config.walk_m_per_sqrt_s = 1.0;
  double walked2 = 0.0, lost_s = 0.0, jumps = 0.0;
  int returns = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    OdometryError error(config, seed, UavIndex{0});
    for (double t = 0.0; t < 300.0; t += kStep_s) {
      const bool had_fix = error.has_fix();
      const Vector3d before = error.position_error_m();
      error.step(kStep_s);
      const Vector3d moved = error.position_error_m() - before;
      if (had_fix && error.has_fix()) {
        EXPECT_LT(moved.norm(), 0.02);
      }
      if (!had_fix && !error.has_fix()) {
        walked2 += moved.squaredNorm();
        lost_s += kStep_s;
      }
      if (had_fix || !error.has_fix()) continue;
      ++returns;
      jumps += moved.norm();
      EXPECT_LT(error.position_error_m().norm(), 1.0) << "with a fix the position is known again";
    }
  }
  EXPECT_NEAR(walked2 / lost_s, 3.0, 0.1) << "the variance grows by 1 m^2 per second on each axis";
  ASSERT_GT(returns, 100);
  EXPECT_GT(jumps / returns, 3.0) << "a fix removes the drift of a minute in one jump";
}

TEST(OdometryError, SeenPointsAppearWhereTheToldPosePutsThem) {
  OdometryError error(conditions_preset("harsh").odometry, 5, UavIndex{0});
  const RigidBodyState truth{.p_WB = {3, -4, 20}, .q_WB = kTilted};
  const Isometry3d X_told_W = error.X_told_W(truth);
  EXPECT_LT((X_told_W * truth.p_WB - error.told(truth).p_WB).norm(), 1e-9);
  // A point 10 m ahead of the body is 10 m ahead of where the UAV takes the body to be.
  const Vector3d p_W = truth.X_WB() * Vector3d(10, 0, 0);
  EXPECT_LT((X_told_W * p_W - error.told(truth).X_WB() * Vector3d(10, 0, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace skein::sim
