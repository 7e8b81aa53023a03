#include "sim_server/sensors/lost_returns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace skein::sim {
namespace {

constexpr Tick kScan = 40;  ///< ticks from one scan to the next
constexpr UavIndex kUav{0};

/// Checks that `count` of n draws is plausible for an event of probability p. A false alarm is rarer than 1e-9.
void expect_binomial(std::size_t count, std::size_t n, double p) {
  const double mean = p * static_cast<double>(n);
  EXPECT_NEAR(static_cast<double>(count), mean, 7.0 * std::sqrt(mean * (1.0 - p)) + 1.0) << n << " of " << p;
}

LidarConfig with_sectors(const DroppedSectors& sectors) {
  LidarConfig config;
  config.dropped_sectors = sectors;
  return config;
}

std::vector<bool> first_ring(const LidarConfig& config, const std::vector<bool>& lost) {
  return {lost.begin(), lost.begin() + config.columns};
}

TEST(LostReturns, NoReturnIsLostByDefaultOrWithSeedZero) {
  LidarConfig both = with_sectors({.share = 0.5, .width_deg = 20.0, .hold_s = 1.0});
  both.no_return_p = 0.5;
  for (LostReturns lost : {LostReturns(LidarConfig{}, kUav, 7), LostReturns(both, kUav, 0)}) {
    EXPECT_FALSE(lost.any());
    EXPECT_EQ(lost.of(kScan), std::vector<bool>(16U * 440U));
  }
  EXPECT_TRUE(LostReturns(both, kUav, 7).any());
}

TEST(LostReturns, EachBeamIsLostIndependently) {
  constexpr Tick kScans = 300;
  for (const double p : {0.02, 0.3, 0.5}) {
    LidarConfig config;
    config.no_return_p = p;
    LostReturns lost(config, kUav, 5);
    std::size_t count = 0, beams = 0, with_next = 0, with_next_ring = 0, with_next_scan = 0;
    std::vector<std::size_t> of_beam(16U * 440U);
    std::vector<bool> before(of_beam.size());
    for (Tick scan = 0; scan < kScans; ++scan) {
      const std::vector<bool>& now = lost.of(scan * kScan);
      ASSERT_EQ(now.size(), of_beam.size());
      beams += now.size();
      for (std::size_t i = 0; i < now.size(); ++i) {
        count += now[i];
        of_beam[i] += now[i];
        // The pairs share no beam, so they are independent draws.
        with_next += i % 2 == 0 && now[i] && now[i + 1];
        with_next_ring += i / 440 % 2 == 0 && now[i] && now[i + 440];
        with_next_scan += scan % 2 == 1 && now[i] && before[i];
      }
      before = now;
    }
    expect_binomial(count, beams, p);
    for (const std::size_t pairs : {with_next, with_next_ring, with_next_scan})
      expect_binomial(pairs, beams / 2, p * p);
    for (const std::size_t of_one : of_beam) expect_binomial(of_one, kScans, p);
  }
}

TEST(LostReturns, LostReturnsDependOnSeedUavAndScanAlone) {
  LidarConfig config = with_sectors({.share = 0.3, .width_deg = 20.0, .hold_s = 0.1});
  config.no_return_p = 0.3;
  for (const double p : {0.0, 0.3}) {  // only sectors, and sectors with single beams
    config.no_return_p = p;
    LostReturns lost(config, kUav, 5), again(config, kUav, 5), other_seed(config, kUav, 6),
        other_uav(config, UavIndex{1}, 5);
    const std::vector<bool> third = lost.of(3 * kScan);
    EXPECT_NE(third, lost.of(4 * kScan));
    EXPECT_EQ(third, again.of(3 * kScan)) << "the result does not depend on earlier calls";
    EXPECT_EQ(third, lost.of(3 * kScan));
    EXPECT_NE(third, other_seed.of(3 * kScan));
    EXPECT_NE(third, other_uav.of(3 * kScan));
  }
}

TEST(LostReturns, SectorsHaveTheirWidthInAllRingsAndTheirShareOnAverage) {
  struct Case {
    double share, width_deg;
    int columns, width;  ///< of the LiDAR, and of a sector
  };
  for (const auto& [share, width_deg, columns, width] :
       {Case{0.1, 30.0, 440, 37}, Case{0.5, 1.0, 440, 1}, Case{0.5, 180.0, 440, 220}, Case{0.5, 300.0, 440, 367},
        Case{0.3, 360.0, 16, 16}, Case{0.02, 90.0, 440, 110}, Case{0.25, 0.01, 16, 1}, Case{0.0, 30.0, 440, 37}}) {
    LidarConfig config = with_sectors({.share = share, .width_deg = width_deg, .hold_s = 0.1});
    config.rings = 3;
    config.columns = columns;
    LostReturns lost(config, kUav, 9);
    constexpr std::size_t kHolds = 4000;
    const double mean = share * columns / width;
    const auto fewest = static_cast<std::size_t>(mean);
    std::size_t more = 0;
    std::vector<std::size_t> of_column(static_cast<std::size_t>(columns));
    for (std::size_t hold = 0; hold < kHolds; ++hold) {
      const std::vector<bool>& beams = lost.of(static_cast<Tick>(hold) * kScan);
      const std::vector<bool> ring = first_ring(config, beams);
      for (int other = 1; other < config.rings; ++other) {
        ASSERT_TRUE(std::equal(ring.begin(), ring.end(), beams.begin() + other * columns));
      }
      const auto blind = static_cast<std::size_t>(std::ranges::count(ring, true));
      ASSERT_EQ(blind % static_cast<std::size_t>(width), 0U) << "sectors are whole and do not overlap";
      const std::size_t sectors = blind / static_cast<std::size_t>(width);
      ASSERT_TRUE(sectors == fewest || sectors == fewest + 1) << sectors;
      more += sectors - fewest;
      for (std::size_t column = 0; column < ring.size(); ++column) of_column[column] += ring[column];
      // Counted from a column that is not blind, each run of blind columns consists of whole sectors.
      const auto seeing = static_cast<std::size_t>(std::ranges::find(ring, false) - ring.begin());
      std::size_t run = 0;
      for (std::size_t i = 0; seeing < ring.size() && i <= ring.size(); ++i) {
        if (ring[(seeing + i) % ring.size()]) {
          ++run;
        } else {
          ASSERT_EQ(run % static_cast<std::size_t>(width), 0U);
          run = 0;
        }
      }
    }
    expect_binomial(more, kHolds, mean - static_cast<double>(fewest));
    for (const std::size_t of_one : of_column) expect_binomial(of_one, kHolds, share);
  }
}

TEST(LostReturns, SectorsStayForTheirTime) {
  const LidarConfig config = with_sectors({.share = 0.3, .width_deg = 20.0, .hold_s = 1.7});
  LostReturns lost(config, kUav, 11);
  constexpr std::size_t kScansOfAHold = 17, kHolds = 60;
  std::set<std::vector<bool>> all;
  std::vector<bool> held;
  for (std::size_t scan = 0; scan < kHolds * kScansOfAHold; ++scan) {
    const std::vector<bool>& now = lost.of(static_cast<Tick>(scan) * kScan);
    if (scan % kScansOfAHold == 0) held = now;
    ASSERT_EQ(now, held) << scan;
    all.insert(now);
  }
  EXPECT_EQ(all.size(), kHolds);
}

TEST(LostReturns, BothKindsTogetherLoseTheUnionOfTheirLosses) {
  LidarConfig beams, both = with_sectors({.share = 0.3, .width_deg = 20.0, .hold_s = 1.0});
  const LidarConfig sectors = both;
  beams.no_return_p = both.no_return_p = 0.3;
  LostReturns lost_both(both, kUav, 3), lost_beams(beams, kUav, 3), lost_sectors(sectors, kUav, 3);
  for (Tick tick = 0; tick < 40 * kScan; tick += kScan) {
    const std::vector<bool>&of_beams = lost_beams.of(tick), &of_sectors = lost_sectors.of(tick);
    const std::vector<bool>& of_both = lost_both.of(tick);
    for (std::size_t i = 0; i < of_both.size(); ++i) ASSERT_EQ(of_both[i], of_beams[i] || of_sectors[i]);
  }
}

}  // namespace
}  // namespace skein::sim
