// Compares braking trajectories, and distances between them, with closed forms and with many samples.
#include "sim_server/flight_check/braking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr double kTolerance = 0.01;

Vector3d drawn_place(RandomStream& random) { return test::random_in_box(random, {-5, -5, -5}, {5, 5, 5}); }

Braking drawn_braking(RandomStream& random) {
  return {.p_W = drawn_place(random),
          .v_W = random.uniform(0.0, 8.0) * test::random_unit(random),
          .delay_s = random.uniform(0.0, 0.3),
          .deceleration_mps2 = random.uniform(1.0, 6.0)};
}

TEST(Braking, ABodyFliesOnForTheDelayAndThenStopsAfterVSquaredByTwoA) {
  RandomStream random(1, "braking", 0);
  for (int i = 0; i < 200; ++i) {
    const Braking braking = drawn_braking(random);
    const double v = braking.v_W.norm(), a = braking.deceleration_mps2;
    const Vector3d way = braking.end_W() - braking.p_W;
    EXPECT_NEAR(way.norm(), v * braking.delay_s + v * v / (2.0 * a), 1e-9);
    EXPECT_NEAR(way.norm(), braking.way_m(), 1e-9);
    EXPECT_NEAR(way.dot(braking.v_W), way.norm() * v, 1e-9) << "straight on";
    const double t = random.uniform(0.0, braking.delay_s);
    EXPECT_LT((braking.at(t) - braking.p_W - t * braking.v_W).norm(), 1e-9) << "during the delay it flies on";
    EXPECT_LT((braking.at(braking.rest_s() + 9.0) - braking.end_W()).norm(), 1e-9) << "it stands";
    const double dt = 1e-4, late = braking.delay_s + 0.5 * v / a;
    EXPECT_NEAR((braking.at(late + dt) - braking.at(late - dt)).norm() / (2.0 * dt), 0.5 * v, 1e-6) << "half as fast";
  }
}

TEST(Braking, ABodyThatStandsStays) {
  const Braking braking{.p_W = {1, 2, 3}, .delay_s = 0.1};
  EXPECT_EQ(braking.way_m(), 0.0);
  EXPECT_EQ(braking.end_W(), Vector3d(1, 2, 3));
}

TEST(Braking, SegmentsAreAsFarApartAsTheirNearestPoints) {
  RandomStream random(2, "segments", 0);
  for (int i = 0; i < 300; ++i) {
    const Vector3d a = drawn_place(random), b = i % 7 == 0 ? a : drawn_place(random);
    const Vector3d c = drawn_place(random), d = i % 5 == 0 ? Vector3d(c + 0.5 * (b - a)) : drawn_place(random);
    double least = 1e9;
    constexpr int kParts = 200;
    for (int k = 0; k <= kParts; ++k) {
      // Projects a point of the first segment onto the second one: the nearest point there.
      const Vector3d p = a + (b - a) * k / kParts, way = d - c;
      const double share = way.norm() > 0.0 ? std::clamp((p - c).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.0;
      least = std::min(least, (p - c - share * way).norm());
    }
    const double found = distance_of_segments(a, b, c, d);
    EXPECT_LE(found, least + 1e-9) << i;
    EXPECT_GE(found, least - (b - a).norm() / (2 * kParts) - 1e-9) << i;
  }
}

TEST(Braking, TwoHeadOnBodiesApproachByTheSumOfTheirBrakingDistances) {
  RandomStream random(3, "head_on", 0);
  for (int i = 0; i < 100; ++i) {
    Braking a = drawn_braking(random), b = drawn_braking(random);
    const Vector3d to_b = test::random_unit(random);
    const double gap = random.uniform(0.0, 5.0);
    a.v_W = a.v_W.norm() * to_b;
    b.v_W = -b.v_W.norm() * to_b;
    b.p_W = a.p_W + (a.way_m() + b.way_m() + gap) * to_b;
    EXPECT_NEAR(least_distance(a, b, 50.0, kTolerance).value, gap, kTolerance + 1e-9);
  }
}

TEST(Braking, TheLeastDistanceOfTwoBrakingBodiesAgreesWithSamples) {
  RandomStream random(4, "pairs", 0);
  int near = 0;
  for (int i = 0; i < 300; ++i) {
    const Braking a = drawn_braking(random), b = drawn_braking(random);
    double least = 1e9;
    for (double t = 0.0; t < std::max(a.rest_s(), b.rest_s()); t += 1e-3) {
      least = std::min(least, (a.at(t) - b.at(t)).norm());
    }
    const Least found = least_distance(a, b, 50.0, kTolerance);
    EXPECT_NEAR(found.value, least, kTolerance + 0.01) << i;
    EXPECT_DOUBLE_EQ(found.value, (a.at(found.at) - b.at(found.at)).norm()) << "the distance at the reported time";
    // A distance that is greater than the requested maximum is reported as that maximum.
    const double most = random.uniform(0.0, 6.0);
    const Least asked = least_distance(a, b, most, kTolerance);
    EXPECT_NEAR(asked.value, std::min(most, least), kTolerance + 0.01) << i;
    near += least < most;
    // At the same time, the bodies are never nearer to each other than their paths are.
    EXPECT_GE(found.value, distance_of_segments(a.p_W, a.end_W(), b.p_W, b.end_W()) - 1e-9) << i;
  }
  EXPECT_GT(near, 30);
}

}  // namespace
}  // namespace skein::sim
