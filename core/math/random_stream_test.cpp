#include "core/math/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace skein {
namespace {

TEST(RandomStream, DependsOnNothingButItsKey) {
  RandomStream a(7, "lidar_noise", 3, 11), b(7, "lidar_noise", 3, 11);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
}

TEST(RandomStream, EveryPartOfTheKeyMatters) {
  std::set<std::uint64_t> firsts;
  firsts.insert(RandomStream(7, "noise", 3, 11).bits());
  firsts.insert(RandomStream(8, "noise", 3, 11).bits());
  firsts.insert(RandomStream(7, "voice", 3, 11).bits());
  firsts.insert(RandomStream(7, "noise", 4, 11).bits());
  firsts.insert(RandomStream(7, "noise", 3, 12).bits());
  firsts.insert(RandomStream(7, "noise", "3", 11).bits());
  EXPECT_EQ(firsts.size(), 6u);
}

/// Computed by an independent program. Runs recorded with one version of Skein must repeat with the next: these
/// numbers may never change.
TEST(RandomStream, YieldsTheRecordedNumbers) {
  RandomStream random(1, "start_offset", 0, 0);
  EXPECT_EQ(random.bits(), 16956927275007445757u);
  EXPECT_EQ(random.uniform(), 0.530873220995921);
  EXPECT_NEAR(random.normal(), -0.2516767979391998, 1e-15);
}

TEST(RandomStream, UniformFillsItsInterval) {
  RandomStream random(1, "test", 0, 0);
  constexpr int kDraws = 200000;
  double sum = 0.0, lowest = 1.0, highest = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 5 * std::sqrt(1.0 / 12 / kDraws));
  EXPECT_LT(lowest, 1e-3);
  EXPECT_GT(highest, 1 - 1e-3);
  for (int i = 0; i < 1000; ++i) {
    const double value = random.uniform(-3.0, 5.0);
    ASSERT_GE(value, -3.0);
    ASSERT_LT(value, 5.0);
  }
}

TEST(RandomStream, NormalDrawsHaveTheMomentsOfTheNormalDistribution) {
  RandomStream random(1, "test", 1, 0);
  constexpr int kDraws = 400000;
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
    fourths += value * value * value * value;
    beyond_two += std::abs(value) > 2.0;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 5 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 5 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(fourths / kDraws, 3.0, 5 * std::sqrt(96.0 / kDraws));
  EXPECT_NEAR(static_cast<double>(beyond_two) / kDraws, 0.0455, 0.002);
}

/// The first numbers of SplitMix64 from 0, as its authors' program prints them.
TEST(NumberedBits, AreThoseOfSplitMix64) {
  EXPECT_EQ(numbered_bits(0, 0), 0xe220a8397b1dcdafU);
  EXPECT_EQ(numbered_bits(0, 1), 0x6e789e6aa1b965f4U);
  EXPECT_EQ(numbered_bits(0, 2), 0x06c45d188009454fU);
}

TEST(PortableLog, AgreesWithTheLibrary) {
  RandomStream random(1, "test", 2, 0);
  for (int i = 0; i < 100000; ++i) {
    const double x = random.uniform() * std::ldexp(1.0, static_cast<int>(random.bits() % 120) - 60) + 1e-300;
    ASSERT_NEAR(portable_log(x), std::log(x), 1e-15 * (1.0 + std::abs(std::log(x)))) << x;
  }
  EXPECT_EQ(portable_log(1.0), 0.0);
}

}  // namespace
}  // namespace skein
