// Tests the criterion of free_evidence.hpp with a million random members that cross a tube which the map calls free:
// counts those that the LiDAR has not seen.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

#include "tests/sensing/drawn_members.hpp"

namespace skein::sensing {
namespace {

class DrawnMembers : public testing::TestWithParam<std::size_t> {};

TEST_P(DrawnMembers, AreSeenWhereATubeIsFree) {
  const Flight flight = flights()[GetParam()];
  const SensedSpace space(flight, kServoPhaseS, {});
  RandomStream random(GetParam() + 1, "drawn_members", 0);
  constexpr std::size_t kDraws = 170'000;
  const std::vector<Tally> by_distance = draw_members(space, random, kDraws);
  const Tally all = sum(by_distance);
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

/// The worst case: a wire parallel to a line of beams, between it and the next line. Lines are half a degree apart, so
/// up to 5.7 m, no wire of 5 cm fits between two lines.
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
