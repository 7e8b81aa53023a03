// A UAV that starts below a canopy finds its way out, although no free cubes of the planner's map lead there.
#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

/// A roof that hangs low over the start of the fleet, and a tower in a box beyond it.
TestScene canopy(std::uint64_t seed) {
  RandomStream random(seed, "flock_canopy_test", 0);
  const double under_m = random.uniform(4.8, 5.6), half_m = random.uniform(5.0, 9.0);
  const Vector3d at(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), under_m + 0.5);
  TestScene scene;
  scene.solids = {make_box({30.0, 0.0, 7.0}, {6.0, 6.0, 14.0}), make_box(at, {2.0 * half_m, 2.0 * half_m, 1.0})};
  scene.boxes = {make_box({30.0, 0.0, 8.0}, {10.0, 10.0, 16.0})};
  return scene;
}

TEST(FlockCanopy, AnExplorerThatStartsBelowACanopyFindsWork) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const TestScene scene = canopy(seed);
    TestWorld world(scene, {{"a", Role::explorer, {0.0, 0.0}}}, "flock", 150.0);
    world.run(100.0);
    const double roof_m = scene.solids[1].center.z();
    EXPECT_GT(world.coverage(), 0.2) << "seed " << seed << ", a roof at " << roof_m << " m, at "
                                     << world.position(0).transpose();
    EXPECT_GT(world.clearance(), kExplorerRadiusM) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skein::agent
