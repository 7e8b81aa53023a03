#include "uav_agent/flight/body_fit.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr double kRadiusM = 1.63, kGroundM = 0.3, kHalfM = 8.0;

Vector3d drawn_W(RandomStream& random) {
  const auto along = [&] { return random.uniform(-kHalfM, kHalfM); };
  const double x = along(), y = along(), z = along();
  return {x, y, z};
}

/// Makes about half of the drawn space free.
void clear_places(WorldMap& map, RandomStream& random) {
  for (int i = 0; i < 40; ++i) map.set_free(drawn_W(random), 3.0);
}

bool slow_ball_free(const WorldMap& map, const Vector3d& p_W, double radius_m) {
  std::vector<WorldMap::Cube> not_free;
  map.not_free_near(p_W, radius_m, kGroundM, not_free);
  return not_free.empty();
}

TEST(BodyFit, FitsWhereTheBallAboutThePlaceIsFree) {
  for (std::uint64_t world = 1; world <= 5; ++world) {
    RandomStream random(world, "fit", 0);
    WorldMap map(WorldMap::Config{});
    clear_places(map, random);
    BodyFit fit(kRadiusM, kGroundM);
    fit.update(map, 0);
    int fitting = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vector3d p_W = drawn_W(random);
      const double radius_m = random.uniform(0.0, 3.0);
      ASSERT_EQ(map.ball_free(p_W, radius_m, kGroundM), slow_ball_free(map, p_W, radius_m)) << p_W.transpose();
      ASSERT_EQ(fit.fits(p_W), slow_ball_free(map, p_W, kRadiusM)) << p_W.transpose();
      fitting += fit.fits(p_W) ? 1 : 0;
    }
    EXPECT_GT(fitting, 100);
    EXPECT_LT(fitting, 2900);
  }
}

TEST(BodyFit, AnswersAnewForAnotherRadius) {
  RandomStream random(6, "fit", 0);
  WorldMap map(WorldMap::Config{});
  clear_places(map, random);
  BodyFit fit(kRadiusM, kGroundM);
  fit.update(map, 0);
  std::vector<Vector3d> places_W;
  for (int i = 0; i < 500; ++i) places_W.push_back(drawn_W(random));
  for (int turn = 0; turn < 6; ++turn) {
    const double radius_m = turn == 5 ? kRadiusM : random.uniform(0.5, 2.5);
    fit.set(radius_m, kGroundM);
    for (const Vector3d& p_W : places_W) ASSERT_EQ(fit.fits(p_W), slow_ball_free(map, p_W, radius_m)) << radius_m;
  }
}

TEST(BodyFit, KeepsAnswersForAWhileAndAsksAgainSoonerWhereTheBodyDidNotFit) {
  const Vector3d here_W(1.25, 1.25, 5.25), beside_W(7.25, 1.25, 5.25);
  const Tick month = Tick{1} << 30;  // an answer keeps 30 bits of its time
  for (const Tick start : {Tick{0}, month - ticks(2.0), month - ticks(1.0), month, 7 * month + 5}) {
    WorldMap map(WorldMap::Config{});
    map.set_free(here_W, 4.0);
    BodyFit fit(kRadiusM, kGroundM);
    fit.update(map, start);
    EXPECT_TRUE(fit.fits(here_W));
    EXPECT_FALSE(fit.fits(beside_W));
    map.set_free(beside_W, 4.0);
    map.hear(map.cube_of(here_W), 0, Space::occupied, 1);
    fit.update(map, start + ticks(0.9));
    EXPECT_TRUE(fit.fits(here_W));
    EXPECT_FALSE(fit.fits(beside_W));
    fit.update(map, start + ticks(1.1));
    EXPECT_TRUE(fit.fits(here_W));
    EXPECT_TRUE(fit.fits(beside_W));
    fit.update(map, start + ticks(4.1));
    EXPECT_FALSE(fit.fits(here_W));
  }
}

}  // namespace
}  // namespace skein::agent
