// The start places of fleets in procedural scenes.
#include "core/scenario/scene_families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

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
    for (std::uint64_t seed = 0; seed < kVariedSeeds; ++seed) {
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

TEST(SceneFamilies, VariedSeedsChangeStartsAndSometimesCrowdThem) {
  for (const SceneFamily& family : scene_families()) {
    int elsewhere = 0, crowded = 0;
    for (std::uint64_t seed = kVariedSeeds; seed < kVariedSeeds + 200; ++seed) {
      const auto starts = scene_starts(family, seed);
      ASSERT_EQ(starts.size(), family.starts.size());
      elsewhere += (starts[0].p_W - family.starts[0]).norm() > 4.0;
      double farthest = 0.0;
      for (std::size_t i = 0; i < starts.size(); ++i) {
        const auto distance = [&](const Vector2d& nominal) { return (starts[i].p_W - nominal).norm(); };
        // Nothing is built within 4 m of a nominal place: there is room for a UAV.
        EXPECT_TRUE(std::ranges::any_of(family.starts, [&](const Vector2d& p) { return distance(p) < 2.4; }));
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_GT((starts[i].p_W - starts[j].p_W).norm(), kRotorSpan) << family.name << ' ' << seed;
          farthest = std::max(farthest, (starts[i].p_W - starts[j].p_W).norm());
        }
      }
      crowded += farthest < 6.0;
    }
    EXPECT_GT(elsewhere, 100) << family.name;
    EXPECT_NEAR(crowded, 50, 25) << family.name;
  }
}

TEST(SceneFamilies, AreFoundByName) {
  for (const SceneFamily& family : scene_families()) EXPECT_EQ(find_scene_family(family.name), &family);
  EXPECT_EQ(find_scene_family("tower"), nullptr);
}

TEST(SceneFamilies, AWrongFamilyIsTheOnlyErrorReportedForAScene) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "s.yaml";
  for (const std::string family : {"tower", "district"}) {
    std::ofstream(file) << "desired_mm_per_pixel: 2\nfleet: [{name: a, vehicle: explorer}]\nscene: {family: " << family
                        << "}\n";
    try {
      load_scenario(file, {.config_dir = source_path("config")});
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(":3: scene.family: "), std::string::npos) << text;
      EXPECT_EQ(text.find("needs a 'start"), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace skein
