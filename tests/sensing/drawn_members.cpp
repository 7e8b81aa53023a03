#include "tests/sensing/drawn_members.hpp"

#include <cmath>

namespace skein::sensing {
namespace {

constexpr double kQuantile = 1.645;  // 95 % of the normal distribution, one-sided

}  // namespace

double Tally::upper_bound() const {
  const double n = static_cast<double>(unseen) + 1.0;
  return n * std::pow(1.0 - 1.0 / (9.0 * n) + kQuantile / (3.0 * std::sqrt(n)), 3) / static_cast<double>(drawn);
}

double Tally::lower_bound() const {
  if (unseen == 0) return 0.0;
  const auto n = static_cast<double>(unseen);
  return n * std::pow(1.0 - 1.0 / (9.0 * n) - kQuantile / (3.0 * std::sqrt(n)), 3) / static_cast<double>(drawn);
}

std::vector<Tally> draw_members(const SensedSpace& space, RandomStream& random, std::size_t draws) {
  constexpr std::size_t kPerTube = 20, kMostTubes = 4'000'000;
  std::vector<Tally> by_distance(20);  // bins of 2 m
  std::size_t drawn = 0;
  for (std::size_t tubes = 0; drawn < draws && tubes < kMostTubes; ++tubes) {
    const auto scan = static_cast<std::size_t>(random.uniform() * static_cast<double>(space.scans().size()));
    const Vector3d middle_W = space.scans()[scan].translation() + random.uniform(1.0, 30.0) * drawn_direction(random);
    const Vector3d half_W = 0.5 * drawn_direction(random);
    if (space.map().at(middle_W) != agent::Space::free) continue;
    if (!space.map().tube_free(middle_W - half_W, middle_W + half_W, kTubeM)) continue;
    Tally here;
    for (; here.drawn < kPerTube; ++here.drawn) {
      const Member member = drawn_member(random, middle_W - half_W, middle_W + half_W);
      if (!space.saw(member, middle_W - half_W, middle_W + half_W, kTubeM)) ++here.unseen;
    }
    drawn += here.drawn;
    by_distance[static_cast<std::size_t>(0.5 * space.distance_to_route_m(middle_W))].add(here);
  }
  return by_distance;
}

Tally sum(const std::vector<Tally>& by_distance) {
  Tally all;
  for (const Tally& tally : by_distance) all.add(tally);
  return all;
}

std::vector<Tally> merged(std::vector<Tally> by_distance) {
  constexpr std::size_t kFewest = 8000;  // with fewer, three unseen members would put the upper bound above 1e-3
  for (std::size_t i = by_distance.size(); i-- > 1;) {
    if (by_distance[i].drawn >= kFewest) continue;
    by_distance[i - 1].add(by_distance[i]);
    by_distance[i] = {};
  }
  return by_distance;
}

}  // namespace skein::sensing
