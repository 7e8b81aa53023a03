#include "cli/study/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace skein::cli {
namespace {

/// Reference implementation: enumerates all ways to give the differences signs.
double slow_p(const std::vector<double>& differences) {
  std::vector<double> sizes;
  std::vector<bool> positive;
  for (const double d : differences) {
    if (d == 0.0) continue;
    sizes.push_back(std::abs(d));
    positive.push_back(d > 0.0);
  }
  if (sizes.empty()) return 1.0;
  const auto rank_of = [&](double size) {  // equal sizes share the mean of their ranks
    const auto below = std::ranges::count_if(sizes, [&](double other) { return other < size; });
    return static_cast<double>(below) + 0.5 * static_cast<double>(std::ranges::count(sizes, size) + 1);
  };
  const auto sum_of = [&](const auto& has_sign) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) sum += has_sign(i) ? rank_of(sizes[i]) : 0.0;
    return sum;
  };
  const double middle = 0.5 * sum_of([](std::size_t) { return true; });
  const double off = std::abs(sum_of([&](std::size_t i) { return positive[i]; }) - middle);
  std::size_t as_uneven = 0;
  for (std::size_t signs = 0; signs < std::size_t{1} << sizes.size(); ++signs) {
    const double sum = sum_of([&](std::size_t i) { return (signs >> i & 1) != 0; });
    as_uneven += std::abs(sum - middle) >= off - 1e-9 ? 1 : 0;
  }
  return static_cast<double>(as_uneven) / static_cast<double>(std::size_t{1} << sizes.size());
}

TEST(SignedRankTest, AgreesWithTheEnumerationOfAllSigns) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> differences(random() % 11);
    const unsigned most = trial % 2 == 0 ? 6 : 100'000;  // with ties and zeros, and without
    for (double& d : differences) d = static_cast<double>(random() % most) - static_cast<double>(most / 2);
    const SignedRank test = signed_rank_test(differences);
    ASSERT_NEAR(test.p, slow_p(differences), 1e-12);
    ASSERT_TRUE(test.exact);
    ASSERT_EQ(test.used, differences.size() - static_cast<std::size_t>(std::ranges::count(differences, 0.0)));
  }
}

// Critical values of the smaller rank sum, two-sided, from printed tables (McCornack, JASA 60, 1965, 864-871): for
// n = 6, 7, 8, 9, 10, the greatest sums with p <= 0.05 are 0, 2, 3, 5, 8; for n = 5, there is none.
TEST(SignedRankTest, HasTheCriticalValuesOfPrintedTables) {
  const std::map<int, int> critical = {{5, -1}, {6, 0}, {7, 2}, {8, 3}, {9, 5}, {10, 8}};
  for (const auto& [n, most] : critical) {
    int greatest = -1;
    for (int smaller = 0; smaller <= n * (n + 1) / 4; ++smaller) {
      std::vector<double> differences;  // their negative ranks, chosen from the greatest on, sum to `smaller`
      int left = smaller;
      for (int rank = n; rank > 0; --rank) {
        const bool negative = rank <= left;
        left -= negative ? rank : 0;
        differences.push_back(negative ? -rank : rank);
      }
      if (signed_rank_test(differences).p <= 0.05) greatest = smaller;
    }
    EXPECT_EQ(greatest, most) << n;
  }
}

TEST(SignedRankTest, TheNormalApproximationForManyPairsIsCloseToTheExactValue) {
  std::mt19937 random(7);
  std::vector<double> differences;
  for (int i = 0; i < 100; ++i) differences.push_back(static_cast<double>(random() % 1000) - 440.0);
  const SignedRank exact = signed_rank_test(differences);
  differences.push_back(1e-3);  // the smallest difference has hardly any weight
  const SignedRank normal = signed_rank_test(differences);
  EXPECT_TRUE(exact.exact);
  EXPECT_FALSE(normal.exact);
  EXPECT_NEAR(exact.p, normal.p, 0.01);
}

TEST(MedianInterval, IsTheSameInAnyOrderAndWithinTheValues) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> values(1 + random() % 20);
    for (double& value : values) value = static_cast<double>(random() % 1000);
    const Interval interval = median_interval(values);
    const auto [least, greatest] = std::ranges::minmax(values);
    ASSERT_LE(least, interval.low);
    ASSERT_LE(interval.low, interval.high);
    ASSERT_LE(interval.high, greatest);
    std::ranges::shuffle(values, random);
    const Interval again = median_interval(values);
    ASSERT_EQ(interval.low, again.low);
    ASSERT_EQ(interval.high, again.high);
    for (double& value : values) value += 5.0;
    ASSERT_DOUBLE_EQ(median_interval(values).low, interval.low + 5.0) << "the interval moves with the values";
  }
}

/// Reference implementation: enumerates every sample that can be drawn from the values.
Interval slow_interval(const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<double> medians;
  std::vector<std::size_t> drawn(n, 0);
  for (bool more = true; more;) {
    std::vector<double> sample;
    for (const std::size_t i : drawn) sample.push_back(values[i]);
    std::ranges::sort(sample);
    medians.push_back(0.5 * (sample[(n - 1) / 2] + sample[n / 2]));
    std::size_t at = 0;
    while (at < n && ++drawn[at] == n) drawn[at++] = 0;
    more = at < n;
  }
  std::ranges::sort(medians);
  const auto below = static_cast<std::size_t>(std::ceil(0.025 * static_cast<double>(medians.size())));
  return {medians[below - 1], medians[medians.size() - below]};
}

TEST(MedianInterval, AgreesWithTheEnumerationOfAllSamples) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<double> values(1 + random() % 7);
    const unsigned most = trial % 2 == 0 ? 4 : 100'000;  // with ties, and without
    for (double& value : values) value = static_cast<double>(random() % most);
    const Interval fast = median_interval(values), slow = slow_interval(values);
    ASSERT_EQ(fast.low, slow.low) << testing::PrintToString(values);
    ASSERT_EQ(fast.high, slow.high) << testing::PrintToString(values);
  }
}

/// With too many values to enumerate all samples, 10 000 random samples stand for them: the true 2.5 % quantile lies
/// between their 1.6 % and 3.4 % quantiles.
TEST(MedianInterval, OfManyValuesAgreesWithRandomSamples) {
  std::mt19937 random(13);
  for (const std::size_t n : {40, 101, 500}) {
    std::vector<double> values(n), sample(n), medians(10'000);
    for (double& value : values) value = static_cast<double>(random() % 1'000'000);
    for (double& median : medians) {
      for (double& value : sample) value = values[random() % n];
      std::ranges::sort(sample);
      median = 0.5 * (sample[(n - 1) / 2] + sample[n / 2]);
    }
    std::ranges::sort(medians);
    const Interval interval = median_interval(values);
    EXPECT_LE(medians[160], interval.low) << n;
    EXPECT_GE(medians[340], interval.low) << n;
    EXPECT_LE(medians[9'659], interval.high) << n;
    EXPECT_GE(medians[9'839], interval.high) << n;
  }
}

// For an odd n, the median of a sample is at most the k-th value if more than half of the draws are. The number of such
// draws has a binomial distribution.
TEST(MedianInterval, OfAnOddNumberOfValuesEndsAtTheQuantilesOfTheBinomial) {
  for (const int n : {5, 9, 15, 101}) {
    std::vector<double> values;
    for (int k = 1; k <= n; ++k) values.push_back(k);
    const auto share_at_most = [&](int k) {
      double share = 0.0, ways = 1.0;
      for (int hits = 0; hits <= n; ++hits) {
        if (hits > n / 2) share += ways * std::pow(double(k) / n, hits) * std::pow(1.0 - double(k) / n, n - hits);
        ways *= double(n - hits) / (hits + 1);
      }
      return share;
    };
    const Interval interval = median_interval(values);
    const int low = static_cast<int>(interval.low), high = static_cast<int>(interval.high);
    EXPECT_GE(share_at_most(low), 0.025) << n;
    EXPECT_LT(share_at_most(low - 1), 0.025) << n;
    EXPECT_GT(share_at_most(high), 0.975) << n;
    EXPECT_LE(share_at_most(high - 1), 0.975) << n;
  }
}

/// Computed by hand: 0.01 * 4 = 0.04, 0.02 * 3 = 0.06, 0.03 * 2 = 0.06, and 0.5.
TEST(Holm, MultipliesTheSmallestMostAndKeepsTheOrder) {
  const std::vector<double> corrected = holm({0.03, 0.5, 0.01, 0.02});
  const std::vector<double> expected = {0.06, 0.5, 0.04, 0.06};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(corrected[i], expected[i], 1e-12);
  EXPECT_EQ(holm({0.4, 0.9}), (std::vector<double>{0.8, 0.9}));
  EXPECT_EQ(holm({0.7, 0.9}), (std::vector<double>{1.0, 1.0}));
  EXPECT_TRUE(holm({}).empty());
}

}  // namespace
}  // namespace skein::cli
