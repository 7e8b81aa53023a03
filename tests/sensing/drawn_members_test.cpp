// The criterion of free_evidence.hpp asked of a million members: how many of those that cross a tube that the map calls
// free has the LiDAR not seen?
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

#include "tests/sensing/sensed_space.hpp"

namespace skein::sensing {
namespace {

constexpr double kTubeM = kBodyRadiusM + agent::kHaloM;
constexpr double kServoPhaseS = 3.0;  // on its way to the stop: a whole sweep begins within a second

struct Tally {
  std::size_t drawn = 0, unseen = 0;

  void add(const Tally& other) {
    drawn += other.drawn;
    unseen += other.unseen;
  }
  /// One-sided 95 % bound of the share (Wilson and Hilferty's of the Poisson distribution).
  double upper_bound() const {
    const double n = static_cast<double>(unseen) + 1.0;
    return n * std::pow(1.0 - 1.0 / (9.0 * n) + 1.645 / (3.0 * std::sqrt(n)), 3) / static_cast<double>(drawn);
  }
};

/// By distance from the route, in steps of 2 m; what is too rare for a bound goes to the next nearer one.
std::vector<Tally> merged(std::vector<Tally> by_distance) {
  constexpr std::size_t kFewest = 8000;
  for (std::size_t i = by_distance.size(); i-- > 1;) {
    if (by_distance[i].drawn >= kFewest) continue;
    by_distance[i - 1].add(by_distance[i]);
    by_distance[i] = {};
  }
  return by_distance;
}

class DrawnMembers : public testing::TestWithParam<std::size_t> {};

TEST_P(DrawnMembers, AreSeenWhereATubeIsFree) {
  const Flight flight = flights()[GetParam()];
  const SensedSpace space(flight, kServoPhaseS, {});
  RandomStream random(GetParam() + 1, "drawn_members", 0);
  constexpr std::size_t kDraws = 170'000, kAPlace = 20, kMostPlaces = 4'000'000;
  std::vector<Tally> by_distance(20);
  Tally all;
  for (std::size_t places = 0; all.drawn < kDraws && places < kMostPlaces; ++places) {
    const auto scan = static_cast<std::size_t>(random.uniform() * static_cast<double>(space.scans().size()));
    const Vector3d middle_W = space.scans()[scan].translation() + random.uniform(1.0, 30.0) * drawn_direction(random);
    const Vector3d half_W = 0.5 * drawn_direction(random);
    if (space.map().at(middle_W) != agent::Space::free) continue;
    if (!space.map().tube_free(middle_W - half_W, middle_W + half_W, kTubeM)) continue;
    Tally here;
    for (; here.drawn < kAPlace; ++here.drawn) {
      const Member member = drawn_member(random, middle_W - half_W, middle_W + half_W);
      if (!space.saw(member, middle_W - half_W, middle_W + half_W, kTubeM)) ++here.unseen;
    }
    all.add(here);
    by_distance[static_cast<std::size_t>(0.5 * space.distance_to_route_m(middle_W))].add(here);
  }
  constexpr double kLimit = 1e-3;
  ASSERT_GE(all.drawn, kDraws) << "free tubes are rare";
  std::cout << flight.name << ": " << all.unseen << " of " << all.drawn << " members unseen\n";
  EXPECT_LT(all.upper_bound(), kLimit);
  const std::vector<Tally> bins = merged(by_distance);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (bins[i].drawn == 0) continue;
    EXPECT_LT(bins[i].upper_bound(), kLimit)
        << bins[i].unseen << " of " << bins[i].drawn << ", from " << 2 * i << " m on";
  }
}

INSTANTIATE_TEST_SUITE_P(Flights, DrawnMembers, testing::Range<std::size_t>(0, flights().size()),
                         [](const auto& flight) { return flights()[flight.param].name; });

/// The worst that can be drawn: a wire along a line of beams, between it and the next. Lines are half a degree apart:
/// up to 5.7 m no wire of 5 cm fits between two.
TEST(WiresAlongALineOfBeams, AreSeenUpToFiveMetres) {
  const SensedSpace space(flights().front(), kServoPhaseS, exact_map());
  RandomStream random(3, "wires", 0);
  std::size_t drawn = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto scan = static_cast<std::size_t>(random.uniform() * static_cast<double>(space.scans().size()));
    const Isometry3d& X_WL = space.scans()[scan];
    const double azimuth = random.uniform(-3.14, 3.14), elevation = random.uniform(-0.26, 0.26);
    const double range = random.uniform(1.5, 5.0);
    const Vector3d radial(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                          std::sin(elevation));
    Member wire;
    wire.p_W = X_WL * (range * radial);
    wire.direction_W = X_WL.linear() * Vector3d(-std::sin(azimuth), std::cos(azimuth), 0.0);
    if (!space.map().tube_free(wire.p_W, wire.p_W, kTubeM)) continue;
    ++drawn;
    EXPECT_TRUE(space.saw(wire, wire.p_W, wire.p_W, kTubeM)) << range << " m: " << wire.p_W.transpose();
  }
  EXPECT_GT(drawn, 5000u);
}

}  // namespace
}  // namespace skein::sensing
