// Where fleets start in procedural scenes.
#include "core/scene_families.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

constexpr double kRotorSpan = 1.3;  ///< two of the largest UAVs side by side

TEST(SceneFamilies, SeedZeroStartsAtTheNominalPlaces) {
  for (const SceneFamily& family : scene_families()) {
    const auto starts = scene_starts(family, 0);
    ASSERT_EQ(starts.size(), family.starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
      EXPECT_EQ(starts[i].p_W, family.starts[i]);
      EXPECT_EQ(starts[i].yaw, 0.0);
    }
  }
}

TEST(SceneFamilies, StartsOfEverySeedAreApartNearTheNominalOnesAndRepeatable) {
  for (const SceneFamily& family : scene_families()) {
    EXPECT_GE(family.starts.size(), 5u) << family.name;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const auto starts = scene_starts(family, seed), again = scene_starts(family, seed);
      for (std::size_t i = 0; i < starts.size(); ++i) {
        EXPECT_EQ(starts[i].p_W, again[i].p_W);
        EXPECT_LE((starts[i].p_W - family.starts[i]).norm(), 2.0 + 1e-12);
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_GT((starts[i].p_W - starts[j].p_W).norm(), kRotorSpan) << family.name << ' ' << seed;
        }
      }
    }
    EXPECT_NE(scene_starts(family, 1)[0].p_W, scene_starts(family, 2)[0].p_W);
  }
}

TEST(SceneFamilies, AreFoundByName) {
  for (const SceneFamily& family : scene_families()) EXPECT_EQ(find_scene_family(family.name), &family);
  EXPECT_EQ(find_scene_family("tower"), nullptr);
}

}  // namespace
}  // namespace skein
