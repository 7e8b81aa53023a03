// A scene's seed gives the scene that it gave before: results that were published with it stay comparable. A family
// that is changed on purpose gets new digests here, by SKEIN_WRITE_DIGESTS=FILE, and a line in CHANGELOG.md.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "core/scenario/scenario_reader.hpp"
#include "core/scenario/scene_families.hpp"
#include "core/text/sha256.hpp"
#include "scenes/scene_source.hpp"
#include "tests/support/places.hpp"

namespace skein::sim {
namespace {

constexpr std::uint64_t kDigestSeeds = 3;

/// Hashes all numbers of the scene as whole tenths of a millimetre, so that the last bits of a sine do not matter.
std::string digest_of(const Scene& scene) {
  Sha256 sha;
  const auto add = [&sha](double value) { sha.add(static_cast<std::uint64_t>(std::llround(1e4 * value))); };
  for (const Eigen::Vector3f& vertex : scene.mesh.vertices) {
    for (const float value : vertex) add(value);
  }
  for (const auto& triangle : scene.mesh.triangles) {
    for (const std::uint32_t corner : triangle) sha.add(static_cast<std::uint64_t>(corner));
  }
  for (const InterestPoint& point : scene.points) {
    for (int axis = 0; axis < 3; ++axis) {
      add(point.p_W[axis]);
      add(point.n_W[axis]);
    }
  }
  for (const OrientedBox& box : scene.boxes) {
    sha.add(box.name);
    for (int axis = 0; axis < 3; ++axis) {
      add(box.center[axis]);
      add(box.size[axis]);
      for (int column = 0; column < 3; ++column) add(box.R_WO(axis, column));
    }
  }
  return sha.hex().substr(0, 16);
}

std::map<std::string, std::string> known_digests() {
  std::map<std::string, std::string> known;
  std::ifstream file(source_path("scenes/scene_digests.csv"));
  for (std::string line; std::getline(file, line);) {
    if (const std::size_t comma = line.find(','); comma != std::string::npos) {
      known[line.substr(0, comma)] = line.substr(comma + 1);
    }
  }
  return known;
}

class SceneDigests : public testing::TestWithParam<std::string> {};

TEST_P(SceneDigests, ASeedGivesTheSceneThatItGaveBefore) {
  const std::map<std::string, std::string> known = known_digests();
  for (std::uint64_t seed = 0; seed < kDigestSeeds; ++seed) {
    const Scene scene =
        load_scene(load_scenario(GetParam(), {.config_dir = source_path("config"), .scene_seed = seed}));
    const std::string name = GetParam() + " " + std::to_string(seed), digest = digest_of(scene);
    if (const char* file = std::getenv("SKEIN_WRITE_DIGESTS")) {
      std::ofstream(file, std::ios::app) << name << "," << digest << "\n";
      continue;
    }
    const auto found = known.find(name);
    ASSERT_NE(found, known.end()) << name << " is not in scene_digests.csv";
    EXPECT_EQ(digest, found->second) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SceneDigests, testing::Values("cranes", "hangar", "sail", "spire", "towers"));

}  // namespace
}  // namespace skein::sim
