#include "uav_agent/onboard/cpu_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

TEST(CpuHistogram, WithoutExchangesAllIsZero) {
  const CpuHistogram none;
  EXPECT_EQ(none.total_s(), 0.0);
  EXPECT_EQ(none.max_s(), 0.0);
  EXPECT_EQ(none.quantile_s(0.99), 0.0);
  EXPECT_EQ(none.over_field_exchange(), 0U);
}

TEST(CpuHistogram, QuantilesAreCloseToThoseOfTheTimes) {
  RandomStream random(1, "cpu", 0);
  for (const std::size_t count : {1U, 7U, 100U, 5000U}) {
    CpuHistogram histogram;
    std::vector<double> times;
    for (std::size_t i = 0; i < count; ++i) {
      times.push_back(std::exp(random.uniform(std::log(1e-7), std::log(10.0))));
      histogram.add(times.back());
    }
    std::ranges::sort(times);
    for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
      const double exact = times[static_cast<std::size_t>(std::ceil(share * static_cast<double>(count))) - 1];
      const double told = histogram.quantile_s(share);
      EXPECT_GE(told, exact * (1.0 - 1e-12)) << share << " of " << count;
      EXPECT_LE(told, std::max(1.05 * exact, 1e-6)) << share << " of " << count;
    }
    EXPECT_EQ(histogram.max_s(), times.back());
    EXPECT_EQ(histogram.quantile_s(1.0), times.back());
    EXPECT_EQ(histogram.count(), count);
    const auto slow = std::ranges::count_if(times, [](double t) { return t > 0.05; });
    EXPECT_EQ(histogram.over_field_exchange(), static_cast<std::uint64_t>(slow));
  }
}

TEST(CpuHistogram, FiftyMillisecondsAreStillInTime) {
  CpuHistogram histogram;
  histogram.add(0.05);
  EXPECT_EQ(histogram.over_field_exchange(), 0U);
  histogram.add(0.0501);
  EXPECT_EQ(histogram.over_field_exchange(), 1U);
  EXPECT_DOUBLE_EQ(histogram.total_s(), 0.1001);
}

TEST(CpuHistogram, AcceptsHoursInOneExchangeAndNegativeTimes) {
  CpuHistogram histogram;
  histogram.add(1e9);
  histogram.add(-1e-9);  // a clock that is read twice in a tick
  EXPECT_EQ(histogram.quantile_s(0.99), 1e9);
  EXPECT_EQ(histogram.total_s(), 1e9);
}

}  // namespace
}  // namespace skein::agent
