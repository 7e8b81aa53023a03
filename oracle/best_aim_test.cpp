// Compares BestAim with a search over a grid of headings and pitches, and with the code that scores captures.
#include "oracle/best_aim.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr double kDesired = 2.0;

double quality(const CameraKind& kind, const RulesConfig& rules, double yaw, double pitch, const Vector3d& ray,
               const Vector3d& n_W) {
  CameraState state;
  state.X_WC.linear() = rotation_z(yaw) * rotation_y(pitch);
  const Exposure exposure(state, kind.camera, kDesired, rules);
  const auto p_C = exposure.view(ray);
  const auto score = p_C ? exposure.score(*p_C, n_W) : std::nullopt;
  return score ? score->score() : 0.0;
}

/// All headings and pitches, two degrees apart.
double best_of_grid(const CameraKind& kind, const RulesConfig& rules, const Vector3d& ray, const Vector3d& n_W) {
  const double step = 2.0 * kRadPerDeg, limit = kind.gimbal.pitch_limit_deg * kRadPerDeg;
  double best = 0.0;
  for (double yaw = -std::numbers::pi; yaw < std::numbers::pi; yaw += step) {
    for (double pitch = -limit; pitch <= limit; pitch += step) {
      best = std::max(best, quality(kind, rules, yaw, pitch, ray, n_W));
    }
  }
  return best;
}

TEST(BestAim, IsAboutAsGoodAsTheBestOfAGridAndHasTheTrueQuality) {
  RandomStream random(1, "best_aim_test", 0);
  for (const char* preset : {"contest", "paper"}) {
    RulesConfig rules;
    rules.unnormalised_displacement = rules.limit_search_radius = std::string(preset) == "contest";
    const CameraKind kind;
    const BestAim camera(kind, kDesired, rules);
    for (int i = 0; i < 40; ++i) {
      // Every fourth point is almost straight below, where the heading is free.
      Vector3d direction = test::random_unit(random);
      if (i % 4 == 0) direction = Vector3d(0.05 * direction.x(), 0.05 * direction.y(), -1.0).normalized();
      const Vector3d ray = random.uniform(2.0, 15.0) * direction, n_W = test::random_unit(random);
      const Aim aim = camera.find(ray, n_W);
      EXPECT_NEAR(aim.q, quality(kind, rules, aim.yaw, aim.pitch, ray, n_W), 1e-9);
      EXPECT_LE(std::abs(aim.pitch), kind.gimbal.pitch_limit_deg * kRadPerDeg);
      // The paper's formula has narrow optima in the picture's corners, which the search may miss.
      const double share = rules.unnormalised_displacement ? 0.96 : 0.8;
      EXPECT_GE(aim.q, share * best_of_grid(kind, rules, ray, n_W)) << preset << ' ' << i;
    }
  }
}

TEST(BestAim, PointsBeyondTheGimbalLimitHaveNoQuality) {
  CameraKind kind;
  kind.gimbal.pitch_limit_deg = 40.0;
  const BestAim camera(kind, kDesired, RulesConfig{});
  const auto at = [](double elevation_deg) {
    const double angle = elevation_deg * kRadPerDeg;
    return Vector3d(5.0 * std::cos(angle), 0.0, 5.0 * std::sin(angle));
  };
  // 40 degrees of pitch and half the picture's height of 60 degrees, in its middle column, make 70 degrees.
  for (const double side : {-1.0, 1.0}) {
    EXPECT_GT(camera.find(at(side * 69.0), -at(side * 69.0).normalized()).q, 0.0);
    EXPECT_EQ(camera.find(at(side * 74.0), -at(side * 74.0).normalized()).q, 0.0);
  }
}

TEST(BestAim, TheQualityOfAFacedSurfaceFallsWithDistanceAndEndsAtTheReach) {
  const CameraKind kind;
  const BestAim contest(kind, kDesired, RulesConfig{});
  const Vector3d n_W = -Vector3d::UnitX();
  double before = 1.0;
  for (double d = 1.0; d < contest.reach(); d += 0.5) {
    const double q = contest.find({d, 0.0, 0.0}, n_W).q;
    EXPECT_LE(q, before + 1e-9);
    before = q;
  }
  EXPECT_EQ(contest.find({resolution_distance(kind.camera, kDesired), 0.0, 0.0}, n_W).q, 1.0);
  EXPECT_EQ(contest.find({contest.reach(), 0.0, 0.0}, n_W).q, 0.0);
  EXPECT_NEAR(contest.reach(), search_radius(kind.camera, kDesired), 1e-12);

  // Without a search radius, min_point_score limits the reach: at the reach, no quality of the point counts.
  RulesConfig far_sighted;
  far_sighted.limit_search_radius = false;
  const BestAim free(kind, kDesired, far_sighted);
  EXPECT_GT(free.reach(), contest.reach());
  for (double turn = -0.65; turn <= 0.65; turn += 0.05) {
    for (double pitch = -0.5; pitch <= 0.5; pitch += 0.05) {
      EXPECT_LT(quality(kind, far_sighted, turn, pitch, {free.reach(), 0.0, 0.0}, n_W), far_sighted.min_point_score);
    }
  }
}

TEST(BestAim, UsesOnlyAllowedHeadings) {
  const BestAim camera(CameraKind{}, kDesired, RulesConfig{});
  const Vector3d ray(6.0, 0.0, -1.0), n_W = -Vector3d::UnitX();
  const double free = camera.find(ray, n_W).q;
  const auto beyond = [](double limit) { return [limit](double yaw) { return yaw >= limit; }; };
  double before = free;
  for (const double limit : {0.1, 0.3, 0.6}) {
    const Aim aim = camera.find(ray, n_W, beyond(limit));
    EXPECT_GE(aim.yaw, limit);
    EXPECT_GT(aim.q, 0.2);
    EXPECT_LE(aim.q, before + 1e-9);
    before = aim.q;
  }
  EXPECT_EQ(camera.find(ray, n_W, beyond(0.8)).q, 0.0) << "half the picture is 40 degrees wide";
}

}  // namespace
}  // namespace skein::sim
