#include "core/scene_families.hpp"

#include <cmath>
#include <numbers>

#include "core/random_stream.hpp"

namespace skein {
namespace {

constexpr double kLargestShift = 2.0;

}  // namespace

std::span<const SceneFamily> scene_families() {
  static const std::vector<SceneFamily> families = {
      {"towers",
       "three towers under a roof deck, in the manner of the benchmark's MBS",
       {{0, 5}, {31, 0}, {58, -13}, {0, -0.5}, {-2, 25}, {-8, 3}, {-8, 12}, {-8, -5}}},
  };
  return families;
}

const SceneFamily* find_scene_family(const std::string& name) {
  for (const SceneFamily& family : scene_families()) {
    if (family.name == name) return &family;
  }
  return nullptr;
}

std::vector<StartPlace> scene_starts(const SceneFamily& family, std::uint64_t scene_seed) {
  std::vector<StartPlace> places;
  for (const Vector2d& nominal : family.starts) {
    StartPlace place{nominal, 0.0};
    if (scene_seed != 0) {
      RandomStream random(scene_seed, std::string(family.name) + "_start", places.size());
      const double heading = random.uniform(0.0, 2.0 * std::numbers::pi), shift = random.uniform(0.0, kLargestShift);
      place.p_W += shift * Vector2d(std::cos(heading), std::sin(heading));
      place.yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace skein
