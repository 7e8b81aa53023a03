// Compares is_clear_line() with the true clearance of each line, densely sampled.
#include "sight/clear_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// Least clearance of places on a line, all closer to each other than `apart`; -1 if it crosses the structure.
double least_room_on(const RayScene& world, const Vector3d& a_W, const Vector3d& b_W, double most, double apart) {
  if (a_W != b_W && world.first_hit_distance(a_W, b_W, {.ground = false, .uavs = false})) return -1.0;
  const int count = std::max(1, static_cast<int>(std::ceil((b_W - a_W).norm() / apart)));
  double least = most;
  for (int i = 0; i <= count; ++i) {
    least = std::min(least, world.clearance(a_W + static_cast<double>(i) / count * (b_W - a_W), most));
  }
  return least;
}

TEST(ClearLine, KeepsItsClearanceExceptForTheTolerance) {
  std::size_t kept = 0, close = 0, lost = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const RayScene world(test::random_triangles(200, seed));
    RandomStream random(seed, "clear_line_test", 0, 0);
    for (int i = 0; i < 300; ++i) {
      const double clearance = random.uniform(0.4, 2.0), tolerance = random.uniform(0.02, 0.2);
      const Vector3d a_W = test::random_in_box(random, {-40.0, -40.0, -40.0}, {40.0, 40.0, 40.0});
      const Vector3d b_W = a_W + random.uniform(0.0, 12.0) * test::random_unit(random);
      const double apart = 0.005, least = least_room_on(world, a_W, b_W, clearance + 1.0, apart);
      // Between two samples a tolerance apart, a line may pass an edge this much closer than both samples.
      const double between = tolerance * tolerance / (8.0 * (clearance - tolerance));
      if (is_clear_line(world, a_W, b_W, clearance, tolerance)) {
        ASSERT_GE(least, clearance - tolerance - between - 1e-6) << seed << ' ' << i;
        least < clearance ? ++close : ++kept;
      } else {
        ASSERT_LT(least, clearance - tolerance + apart) << seed << ' ' << i;
        ++lost;
      }
    }
  }
  EXPECT_GT(kept, 100U);
  EXPECT_GT(close, 10U);
  EXPECT_GT(lost, 100U);
}

}  // namespace
}  // namespace skein::sim
