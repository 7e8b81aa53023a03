#include "sim_server/flight/momentum_keeper.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein::sim {
namespace {

Matrix3d turned(const Matrix3d& R, const Vector3d& w_W, double step_s) {
  const double angle = step_s * w_W.norm();
  return angle > 0.0 ? Matrix3d(Eigen::AngleAxisd(angle, w_W.normalized()).toRotationMatrix() * R) : R;
}

/// A body that an engine without gyroscopic terms turns, from a random state.
class MomentumKeeperTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  static constexpr double kStep = 0.0025;

  MomentumKeeperTest() : random_(GetParam()) {
    inertia_ = Vector3d::Constant(0.06) + 0.04 * some();
    R_WP_ = Quaterniond(Eigen::AngleAxisd(3.0 * some().x(), some().normalized())).toRotationMatrix();
    w_W_ = 8.0 * some();
  }
  Vector3d some() {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    return {any(random_), any(random_), any(random_)};
  }
  Vector3d momentum() const { return R_WP_ * inertia_.cwiseProduct(R_WP_.transpose() * w_W_); }
  /// @param gain_W  what torques and contacts add to the engine's velocity.
  void step(const Vector3d& gain_W = Vector3d::Zero()) {
    MomentumKeeper keeper(inertia_, R_WP_, w_W_, kStep);
    const Vector3d in_engine_W = keeper.middle_velocity() + gain_W;
    const Matrix3d R_after = turned(R_WP_, in_engine_W, kStep);
    w_W_ = keeper.finish(R_after, in_engine_W);
    R_WP_ = R_after;
  }

  std::mt19937_64 random_;
  Vector3d inertia_, w_W_;
  Matrix3d R_WP_;
};

TEST_P(MomentumKeeperTest, AFreeBodyKeepsMomentumAndEnergy) {
  const Vector3d L_W = momentum();
  const double energy = 0.5 * L_W.dot(w_W_);
  for (int i = 0; i < 400; ++i) step();
  EXPECT_LT((momentum() - L_W).norm(), 1e-10 * L_W.norm());
  EXPECT_NEAR(0.5 * L_W.dot(w_W_), energy, 1e-3 * energy) << "after a second";
}

TEST_P(MomentumKeeperTest, TheGainOfAStepIsAddedToTheMomentum) {
  const Vector3d gain_W = some();
  const Vector3d expected = momentum() + R_WP_ * inertia_.cwiseProduct(R_WP_.transpose() * gain_W);
  step(gain_W);
  EXPECT_LT((momentum() - expected).norm(), 1e-12 * (1.0 + expected.norm()));
}

TEST_P(MomentumKeeperTest, ABodyAtRestStaysAtRest) {
  w_W_.setZero();
  step();
  EXPECT_EQ(w_W_, Vector3d::Zero());
}

INSTANTIATE_TEST_SUITE_P(Seeds, MomentumKeeperTest, testing::Range<std::uint64_t>(0, 20));

}  // namespace
}  // namespace skein::sim
