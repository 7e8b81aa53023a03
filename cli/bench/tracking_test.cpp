#include "cli/bench/tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <tuple>

#include "core/math/random_stream.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// A table of random errors below the bound c0 + c1 * speed + c2 * acceleration.
results::TrackingTable drawn_table(double c0, double c1, double c2, int count) {
  results::TrackingTable table;
  RandomStream random(1, "bench_tracking", 0);
  for (int i = 0; i < count; ++i) {
    const double v = random.uniform(0.0, 6.0), a = random.uniform(0.0, 3.0);
    table.add("explorer", v, a, random.uniform(0.7, 1.0) * (c0 + c1 * v + c2 * a));
  }
  return table;
}

TEST(BenchTracking, FindsTheBoundThatTheErrorsHave) {
  for (const auto& [c0, c1, c2] : {std::tuple(0.1, 0.1, 0.05), std::tuple(0.3, 0.0, 0.1), std::tuple(0.05, 0.2, 0.0)}) {
    const TrackingBound bound = fit_bound(drawn_table(c0, c1, c2, 20'000), "explorer", 0.9999);
    EXPECT_GE(bound.covered, 0.9999);
    for (const double v : {0.5, 3.0, 5.5}) {
      for (const double a : {0.25, 1.5, 2.75}) {
        // A bin's samples count with its least speed and acceleration.
        EXPECT_NEAR(bound.at(v, a), c0 + c1 * v + c2 * a, 0.03 + 0.5 * (c1 + c2)) << v << ", " << a;
      }
    }
  }
}

TEST(BenchTracking, TheBoundHoldsForTheRequestedShareOfSamples) {
  results::TrackingTable table;
  for (int i = 0; i < 99; ++i) table.add("explorer", 1.0, 0.0, 0.1);
  table.add("explorer", 1.0, 0.0, 5.0);
  const TrackingBound most = fit_bound(table, "explorer", 0.99), all = fit_bound(table, "explorer", 1.0);
  EXPECT_DOUBLE_EQ(most.covered, 0.99);
  EXPECT_LT(most.at(1.0, 0.0), 0.2);
  EXPECT_DOUBLE_EQ(all.covered, 1.0);
  EXPECT_GE(all.at(1.0, 0.0), 5.0);
  EXPECT_EQ(fit_bound(table, "photographer", 0.99).covered, 0.0) << "the table has no samples of a photographer";
}

TEST(BenchTracking, ReadsWhatARunWrote) {
  const results::TrackingTable written = drawn_table(0.2, 0.1, 0.1, 3000);
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "skein_bench_tracking.csv";
  std::ofstream(file) << written.csv();
  results::TrackingTable table;
  results::read_tracking(file, table);
  EXPECT_EQ(table.bins(), written.bins());
  results::read_tracking(file, table);
  EXPECT_EQ(table.quantiles().samples, 6000U) << "the samples of both runs";
  std::filesystem::remove(file);
  EXPECT_THROW(results::read_tracking(file, table), InputError);
}

TEST(BenchTracking, PrintsARowForEachBinAndABoundForEachVehicle) {
  results::TrackingTable table;
  table.add("explorer", 1.5, 0.0, 0.105);
  table.add("photographer", 9.0, 7.0, 0.305);
  std::ostringstream out;
  print_tracking(out, table);
  EXPECT_NE(out.str().find("explorer            1       0         1    0.11    0.11    0.11    0.11\n"),
            std::string::npos)
      << out.str();
  EXPECT_NE(out.str().find("photographer        7       4         1    0.31"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("photographer: e(v, a) = "), std::string::npos) << out.str();
}

}  // namespace
}  // namespace skein::cli
