#include "core/math/normal_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/random_stream.hpp"

namespace skein {
namespace {

/// Bits of which the upper 63 represent this fraction in (0, 1); the lowest one is the sign.
std::uint64_t bits_of(double fraction) { return static_cast<std::uint64_t>(std::ldexp(fraction, 63)) << 1; }

TEST(NormalTable, TailsHaveTheirProbabilities) {
  const NormalTable& normal = NormalTable::get();
  RandomStream random(1, "normal_table_test", 0);
  for (int i = 0; i < 200'000; ++i) {
    const double tail = std::ldexp(random.uniform(0.5, 1.0), -i % 34);  // 1 to 6e-11
    const double z = normal(bits_of(tail));
    ASSERT_NEAR(std::erfc(z / std::sqrt(2.0)), tail, 2e-4 * tail) << z;
  }
}

/// The test sums over a fine grid of all probabilities instead of draws, so that there is no noise.
TEST(NormalTable, HasTheMomentsOfTheNormalDistribution) {
  const NormalTable& normal = NormalTable::get();
  double mass = 0.0, squares = 0.0, fourths = 0.0, sixths = 0.0;
  for (int octave = 0; octave < 34; ++octave) {
    constexpr int kSteps = 10'000;
    for (int i = 0; i < kSteps; ++i) {
      const double end = std::ldexp(0.5, -octave), width = end / kSteps;
      const double z = normal(bits_of(end + (i + 0.5) * width)), square = z * z;
      mass += width;
      squares += width * square;
      fourths += width * square * square;
      sixths += width * square * square * square;
    }
  }
  EXPECT_NEAR(mass, 1.0, 1e-9);
  EXPECT_NEAR(squares, 1.0, 1e-4);
  EXPECT_NEAR(fourths / (squares * squares), 3.0, 1e-4);
  EXPECT_NEAR(sixths, 15.0, 5e-3);
}

TEST(NormalTable, DrawsHaveTheMomentsOfTheNormalDistributionAndNoCorrelation) {
  const NormalTable& normal = NormalTable::get();
  constexpr int kDraws = 1'000'000;
  double sum = 0.0, squares = 0.0, thirds = 0.0, fourths = 0.0, products = 0.0, before = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double z = normal(numbered_bits(77, i));
    sum += z;
    squares += z * z;
    thirds += z * z * z;
    fourths += z * z * z * z;
    products += z * before;
    before = z;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 5 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 5 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(thirds / kDraws, 0.0, 5 * std::sqrt(15.0 / kDraws));
  EXPECT_NEAR(fourths / kDraws, 3.0, 5 * std::sqrt(96.0 / kDraws));
  EXPECT_NEAR(products / kDraws, 0.0, 5 / std::sqrt(kDraws));
}

TEST(NormalTable, IsMonotonicAndSymmetric) {
  const NormalTable& normal = NormalTable::get();
  RandomStream random(1, "normal_table_test", 1);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t a = (random.bits() | std::uint64_t{1} << 63) >> (i % 34), b = a + (std::uint64_t{1} << 20);
    ASSERT_EQ(normal(a ^ 1U), -normal(a));
    ASSERT_LE(normal(b & ~std::uint64_t{1}), normal(a & ~std::uint64_t{1})) << a;
  }
  EXPECT_GT(normal(0), 6.5);
  EXPECT_LT(normal(0), 6.7);
  EXPECT_NEAR(normal(~std::uint64_t{1}), 0.0, 1e-12);
}

/// The numbers must be the same on each machine, so that recorded runs repeat.
TEST(NormalTable, YieldsTheRecordedNumbers) {
  const NormalTable& normal = NormalTable::get();
  EXPECT_EQ(normal(0x123456789abcdef0), 0x1.ce0771d19a201p+0);
  EXPECT_EQ(normal(0xfedcba9876543211), -0x1.6d13d97af04ep-8);
  EXPECT_EQ(normal(0x0000123456789abc), 0x1.380941d56bc9dp+2);
}

}  // namespace
}  // namespace skein
