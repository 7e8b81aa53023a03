// Properties of the quality formulas; the reference vectors are in sim_server/golden/check_test.cpp.
#include "core/scoring/camera_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"

namespace skein {
namespace {

constexpr double kDesired = 2.0;

/// A level camera at the origin that looks along +x at a wall whose normal is turned about the vertical.
PointQuality look(double distance, double wall_turn, ResolutionRule rule, const Vector3d& v_WC = Vector3d::Zero()) {
  CameraState state;
  state.v_WC = v_WC;
  const Exposure exposure(state, CameraConfig(), kDesired, rule);
  return exposure.evaluate({distance, 0, 0}, rotation_z(wall_turn) * Vector3d(-1, 0, 0));
}

TEST(CameraQuality, ResolutionIsJustMetAtTheResolutionDistance) {
  const double d = resolution_distance({}, kDesired);
  EXPECT_NEAR(d, 7.356, 1e-3);
  EXPECT_NEAR(*look(d, 0, ResolutionRule::contest).mm_per_pixel_u, kDesired, 1e-6);
  EXPECT_EQ(*look(0.9 * d, 0, ResolutionRule::contest).q_res, 1.0);
  EXPECT_NEAR(*look(2.0 * d, 0, ResolutionRule::contest).q_res, 0.5, 1e-6);
}

TEST(CameraQuality, TheSearchRadiusIsThatOfTheContest) {
  EXPECT_NEAR(search_radius({}, 2.0), 15.50, 0.005);
  EXPECT_NEAR(search_radius({}, 1.5), 12.87, 0.01);
  EXPECT_NEAR(search_radius({}, 1.0), 10.25, 0.005);
}

TEST(CameraQuality, ARuleSwitchesTheSearchRadiusOff) {
  // 20 m away a point still has a quality of 0.37; the organisers' camera does not look so far.
  const double d = resolution_distance({}, kDesired);
  RulesConfig rules;
  const Exposure contest({}, {}, kDesired, rules);
  EXPECT_EQ(contest.radius(), search_radius({}, kDesired));
  EXPECT_FALSE(contest.view({20, 0, 0}));
  rules.limit_search_radius = false;
  const Exposure paper({}, {}, kDesired, rules);
  const auto p_C = paper.view({20, 0, 0});
  ASSERT_TRUE(p_C);
  EXPECT_NEAR(paper.score(*p_C, {-1, 0, 0})->score(), d / 20.0, 1e-6);
  EXPECT_FALSE(paper.view({-20, 0, 0})) << "no rule lets a camera see behind itself";
}

TEST(CameraQuality, MoreThanOnePixelOfMotionBlurs) {
  const double d = resolution_distance({}, kDesired);
  const auto blur = [&](double speed) { return look(d, 0, ResolutionRule::contest, {0, speed, 0}).q_blur; };
  EXPECT_EQ(blur(0.0), 1.0);
  EXPECT_EQ(blur(0.99 * kDesired), 1.0);  // 1 ms at 2 m/s is 2 mm: just one pixel
  EXPECT_NEAR(blur(2.0 * kDesired), 0.5, 1e-9);
}

TEST(CameraQuality, SignOfTheNormalDoesNotMatter) {
  for (const auto rule : {ResolutionRule::contest, ResolutionRule::paper}) {
    const Vector3d p(6, 1, -2), n = Vector3d(-1, 0.4, 0.3).normalized();
    const Exposure exposure(CameraState(), CameraConfig(), kDesired, rule);
    EXPECT_EQ(exposure.evaluate(p, n).score, exposure.evaluate(p, -n).score);
  }
}

TEST(CameraQuality, PaperRuleNeverScoresLowerThanTheContestRule) {
  const Exposure by_contest(CameraState(), CameraConfig(), kDesired, ResolutionRule::contest);
  const Exposure by_paper(CameraState(), CameraConfig(), kDesired, ResolutionRule::paper);
  for (int i = 0; i < 200; ++i) {
    const Vector3d n = rotation_z(0.37 * i) * rotation_y(0.11 * i) * Vector3d(-1, 0, 0);
    const Vector3d p(5.0, 3.0 * std::sin(i), 2.0 * std::cos(i));
    EXPECT_GE(*by_paper.evaluate(p, n).q_res, *by_contest.evaluate(p, n).q_res - 1e-12) << n.transpose();
  }
}

TEST(CameraQuality, EdgeOnSurfaceHasNoResolution) {
  for (const auto rule : {ResolutionRule::contest, ResolutionRule::paper}) {
    const Exposure exposure(CameraState(), CameraConfig(), kDesired, rule);
    EXPECT_LT(*exposure.evaluate({5, 0, 0}, {0, 1, 0}).score, 1e-9);
  }
}

TEST(CameraQuality, FastPathAgreesWithTheAudit) {
  RigidBodyState body;
  body.p_WB = {1, 2, 3};
  body.q_WB = Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(0.2, 0.3, 1.0).normalized()));
  body.v_WB = {1, -2, 0.5};
  body.w_WB_B = {0.1, -0.2, 0.3};
  const CameraState state = camera_state(body, {0.2, -0.3, 0.1, -0.4}, {});
  const Exposure exposure(state, {}, kDesired, ResolutionRule::contest);
  int seen = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3d p = body.p_WB + Vector3d(18 * std::sin(1.3 * i), 18 * std::sin(2.7 * i), 18 * std::sin(4.1 * i));
    const Vector3d n = rotation_z(i) * rotation_y(2.0 * i) * Vector3d::UnitX();
    const auto quality = exposure.evaluate(p, n);
    const auto p_C = exposure.view(p);
    ASSERT_EQ(p_C.has_value(), quality.in_fov && quality.in_search_radius);
    if (!p_C) continue;
    ++seen;
    const auto score = exposure.score(*p_C, n);
    ASSERT_EQ(score.has_value(), quality.score.has_value());
    EXPECT_DOUBLE_EQ(score ? score->score() : 0.0, quality.score.value_or(0.0));
  }
  EXPECT_GT(seen, 50);
}

TEST(CameraQuality, DistanceAndTiltAreTheTwoPartsOfTheResolution) {
  const double d = resolution_distance({}, kDesired);
  RandomStream random(1, "camera_quality_test", 0);
  const Exposure exposure({}, {}, kDesired, ResolutionRule::paper);
  for (int i = 0; i < 500; ++i) {
    const double depth = random.uniform(1.0, 4.0 * d);
    const Vector3d p_C = depth * Vector3d(1.0, random.uniform(-0.8, 0.8), random.uniform(-0.5, 0.5));
    const auto frontal = exposure.score(p_C, Vector3d::UnitX());
    const auto tilted =
        exposure.score(p_C, Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized());
    ASSERT_TRUE(frontal && tilted);
    // A frontal surface has no tilt. The part of the distance does not depend on the tilt.
    EXPECT_NEAR(frontal->q_res, frontal->q_distance, 1e-6);
    EXPECT_EQ(tilted->q_distance, frontal->q_distance);
    EXPECT_NEAR(frontal->q_distance, std::min(1.0, d / depth), 1e-12);
  }
}

/// With exposures of 2^-10 s and coordinates of few digits, the formulas compute everything up to 0 / 0 exactly.
TEST(CameraQuality, APointWithAnUndefinedQualityNeverScores) {
  RandomStream random(2, "camera_quality_test", 0);
  const auto draw = [&](int until) { return std::floor(random.uniform(-1.0, 1.0) * until) / 16.0; };
  CameraConfig camera;
  camera.exposure_s = 1.0 / 1024.0;
  const double least = RulesConfig{}.min_point_score;
  for (const auto rule : {ResolutionRule::contest, ResolutionRule::paper}) {
    for (int i = 0; i < 2000; ++i) {
      const Vector3d p_C(1.0 + std::abs(draw(64)), draw(8), draw(8));
      // Moved onto the camera's origin, or into its plane beside or above it.
      const Vector3d landing =
          i % 3 == 0 ? Vector3d::Zero().eval() : Vector3d(0.0, i % 3 == 1 ? 0.0 : draw(8), i % 3 == 1 ? draw(8) : 0.0);
      CameraState state;
      state.v_WC = 1024.0 * (p_C - landing);
      const Exposure exposure(state, camera, kDesired, rule);
      const Vector3d n = i % 5 == 0 ? Vector3d::UnitX().eval() : rotation_z(0.3 * i) * Vector3d::UnitX();
      const auto moved = exposure.score(p_C, n);
      ASSERT_TRUE(moved);
      EXPECT_FALSE(std::isnan(moved->score())) << p_C.transpose();
      EXPECT_LT(moved->score(), least) << p_C.transpose() << " to " << landing.transpose();
      // In the camera's own plane, or half a step in front of it, so that an end of the step may be in this plane.
      for (const Vector3d& degenerate : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.0, p_C.y(), p_C.z()),
                                         Vector3d(0.0005, 0.0, 0.0005), Vector3d(0.0005, 0.0005, 0.0)}) {
        for (const Vector3d& normal : {n, Vector3d(0.0, 0.0, 1.0), Vector3d(0.0, 1.0, 0.0), Vector3d(1.0, 0.0, 0.0)}) {
          const auto score = Exposure(CameraState{}, camera, kDesired, rule).score(degenerate, normal);
          EXPECT_FALSE(score && std::isnan(score->score())) << degenerate.transpose() << " n " << normal.transpose();
          EXPECT_FALSE(score && degenerate.x() <= 0.0);
        }
      }
    }
  }
}

TEST(CameraState, ViewStaysLevelWhenTheBodyTilts) {
  RigidBodyState body;
  body.q_WB =
      Quaterniond(rotation_z(0.7) * rotation_y(0.3) * Eigen::AngleAxisd(-0.4, Vector3d::UnitX()).toRotationMatrix());
  const CameraState state = camera_state(body, {}, {});
  EXPECT_TRUE(state.X_WC.linear().isApprox(rotation_z(0.7), 1e-12));
  EXPECT_TRUE(state.X_WC.translation().isApprox(body.q_WB * Vector3d(0.2, 0, -0.3), 1e-12));
}

TEST(CameraState, PositivePitchLooksDown) {
  const CameraState state = camera_state({}, {0.5, 0, 0, 0}, {});
  EXPECT_LT(state.X_WC.linear().col(0).z(), -0.4);
}

}  // namespace
}  // namespace skein
