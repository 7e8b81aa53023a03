#include "core/scenario/scene_families.hpp"

#include <cmath>
#include <numbers>

#include "core/math/random_stream.hpp"

namespace skein {
namespace {

constexpr double kLargestShift = 2.0;
constexpr double kCrowded = 0.25;    ///< share of the varied seeds with which all UAVs start close together
constexpr double kCrowdStep = 1.45;  ///< distance between neighbours that start close together [m]

/// Shuffles the start places among the UAVs. With some seeds, moves all of them close to one place.
void vary(std::vector<StartPlace>& places, const std::vector<Vector2d>& nominal, RandomStream& random) {
  for (std::size_t i = places.size(); i > 1; --i) {
    std::swap(places[i - 1], places[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  if (random.uniform() >= kCrowded) return;
  const Vector2d& middle = nominal[static_cast<std::size_t>(random.uniform() * static_cast<double>(nominal.size()))];
  const std::size_t last_column = (places.size() - 1) / 2;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t column = i / 2, row = i % 2;
    places[i].p_W = middle + kCrowdStep * Vector2d(static_cast<double>(column) - 0.5 * static_cast<double>(last_column),
                                                   static_cast<double>(row) - 0.5);
  }
}

}  // namespace

std::span<const SceneFamily> scene_families() {
  static const std::vector<SceneFamily> families = {
      {"towers",
       "three towers under a roof deck, in the manner of the benchmark's MBS",
       {{0, 5}, {31, 0}, {58, -13}, {0, -0.5}, {-2, 25}, {-8, 3}, {-8, 12}, {-8, -5}}},
      {"hangar",
       "an airliner of about 70 x 64 x 20 m at the mouth of an open hangar",
       {{-4, 0}, {-4, 8}, {-4, -8}, {-4, 16}, {-4, -16}, {-12, 4}, {-12, -4}, {-12, 12}}},
      {"cranes",
       "two tower cranes and a gantry crane, lattice members down to 5 cm",
       {{8, 6}, {84, 6}, {22, 2}, {46, 5}, {70, 2}, {34, 6}, {58, 6}, {-4, 2}}},
      {"sail",
       "a tall curved shell with terraces and an outer frame, a small one apart",
       {{0, 0}, {0, 8}, {0, -8}, {0, 16}, {0, -16}, {-8, 4}, {-8, -4}, {-8, 12}}},
      {"spire",
       "a stepped tower of 120 m on a wide podium with an arcade",
       {{12, 2}, {60, 2}, {24, -1}, {36, 3}, {48, -1}, {0, 4}, {72, 4}, {-10, -2}}},
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
  if (scene_seed >= kVariedSeeds) {
    RandomStream random(scene_seed, std::string(family.name) + "_who_starts_where", 0);
    vary(places, family.starts, random);
  }
  return places;
}

}  // namespace skein
