// The same as drawn_members_test.cpp, with a LiDAR that loses returns: counts the members that it has not seen. A UAV
// hovers for one sweep of the servo, so that it scans most places once; with a second scan it would miss hardly any
// member.
#include <gtest/gtest.h>

#include <iostream>
#include <optional>

#include "tests/sensing/drawn_members.hpp"

namespace skein::sensing {
namespace {

constexpr double kLimit = 1e-3;

Flight one_sweep() {
  Flight flight = flights().front();
  flight.duration_s = 5.0;
  return flight;
}

LidarConfig losing(double no_return_p, const std::optional<DroppedSectors>& sectors = {}) {
  LidarConfig lidar;
  lidar.no_return_p = no_return_p;
  lidar.dropped_sectors = sectors;
  return lidar;
}

void print(const std::string& what, const Tally& tally) {
  std::cout << what << ": " << tally.unseen << " of " << tally.drawn << " members unseen\n";
}

/// Beams are lost independently; the map uses each beam individually.
class LostBeams : public testing::TestWithParam<double> {
 protected:
  Tally draw(const LidarConfig& told, const char* what) const {
    const SensedSpace space(one_sweep(), kServoPhaseS, exact_map(), losing(GetParam()), told);
    RandomStream random(1, "lost_beams", 0);
    constexpr std::size_t kDraws = 250'000;
    const std::vector<Tally> by_distance = draw_members(space, random, kDraws);
    for (const Tally& tally : merged(by_distance)) {
      if (tally.drawn == 0 || told.no_return_p == 0.0) continue;
      EXPECT_LT(tally.upper_bound(), kLimit) << tally.unseen << " of " << tally.drawn;
    }
    print(what, sum(by_distance));
    EXPECT_GE(sum(by_distance).drawn, kDraws) << "free tubes are rare";
    return sum(by_distance);
  }
};

TEST_P(LostBeams, AreCompensatedByACriterionThatKnowsTheirShare) {
  const Tally knows = draw(losing(GetParam()), "the map knows"), ignores = draw({}, "the map does not know");
  EXPECT_LT(knows.upper_bound(), kLimit);
  EXPECT_GT(ignores.lower_bound(), knows.upper_bound())
      << "a map that ignores lost returns must be worse, or this test cannot fail";
}

INSTANTIATE_TEST_SUITE_P(Shares, LostBeams, testing::Values(0.3, 0.5), [](const auto& p) {
  return "Of" + std::to_string(static_cast<int>(100.0 * p.param)) + "In100";
});

/// Tally of the map that UAVs have, over many draws of lost sectors.
Tally draw_with_sectors(SensedSpace& space, const std::string& what) {
  Tally all;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    space.lose(seed);
    RandomStream random(seed, "dropped_sectors", 0);
    all.add(sum(draw_members(space, random, 2000)));
  }
  print(what, all);
  return all;
}

/// Sectors that are drawn anew several times while the LiDAR scans a place have no more effect than single lost beams.
/// With longer sectors, the LiDAR misses some members; free_evidence.hpp explains this limit.
TEST(DroppedSectors, AreCompensatedIfTheyAreRedrawnWhileTheLidarScansAPlace) {
  for (const double share : {0.1, 0.3}) {
    for (const double hold_s : {0.3, 3.0, 100.0}) {
      const LidarConfig lidar = losing(0.0, DroppedSectors{.share = share, .width_deg = 30.0, .hold_s = hold_s});
      SensedSpace space(one_sweep(), kServoPhaseS, {}, lidar, lidar);
      const std::string what = "share " + std::to_string(share) + ", " + std::to_string(hold_s) + " s";
      const Tally tally = draw_with_sectors(space, what);
      if (hold_s < 0.5) {
        EXPECT_LT(tally.upper_bound(), kLimit) << what;
      } else if (hold_s > 10.0) {
        EXPECT_GT(tally.lower_bound(), kLimit) << what << ": the limit no longer holds, and its comment is out of date";
        EXPECT_LT(tally.upper_bound(), share) << what;
      }
    }
  }
}

}  // namespace
}  // namespace skein::sensing
