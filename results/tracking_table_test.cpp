#include "results/tracking_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "core/math/random_stream.hpp"
#include "results/testing/scratch.hpp"

namespace skein::results {
namespace {

TEST(TrackingTable, QuantilesAreThoseOfTheSamplesRoundedUpToABin) {
  RandomStream random(1, "tracking_table", 0);
  for (const std::size_t count : {1U, 2U, 100U, 20'000U}) {
    TrackingTable table;
    std::vector<double> errors;
    for (std::size_t i = 0; i < count; ++i) {
      errors.push_back(random.uniform(0.0, 1.0) * random.uniform(0.0, 1.0));
      table.add("explorer", random.uniform(0.0, 6.0), random.uniform(0.0, 4.0), errors.back());
    }
    std::ranges::sort(errors);
    const auto quantiles = table.quantiles();
    EXPECT_EQ(quantiles.samples, count);
    const auto expect = [&](double found, double share) {
      const auto n = static_cast<double>(count);
      const double exact = errors[static_cast<std::size_t>(std::max(0.0, std::ceil(share * n - 1e-6) - 1.0))];
      EXPECT_GE(found, exact) << share << " of " << count;
      EXPECT_LE(found, exact + TrackingTable::kErrorStepM + 1e-9) << share << " of " << count;
    };
    expect(quantiles.p50, 0.5);
    expect(quantiles.p99, 0.99);
    expect(quantiles.p9999, 0.9999);
    expect(quantiles.max, 1.0);
  }
}

TEST(TrackingTable, CountsByVehicleSpeedAndAcceleration) {
  TrackingTable table;
  table.add("explorer", 0.49, 0.0, 0.015);
  table.add("explorer", 0.5, 0.0, 0.02);
  table.add("photographer", 0.5, 1.2, 0.031);
  table.add("photographer", 0.6, 1.1, 0.039);
  EXPECT_EQ(table.csv(),
            "vehicle,speed_mps,acceleration_mps2,error_m,samples\n"
            "explorer,0.0,0.0,0.01,1\nexplorer,0.5,0.0,0.02,1\nphotographer,0.5,1.0,0.03,2\n");
  EXPECT_EQ(table.quantiles([](const TrackingTable::Bin& bin) { return bin.vehicle == "explorer"; }).samples, 2U);
  EXPECT_EQ(table.quantiles([](const TrackingTable::Bin& bin) { return bin.speed_mps() > 5.0; }).max, 0.0);
}

TEST(TrackingTable, AnErrorBeyondTheTableCountsInItsLastBin) {
  TrackingTable table;
  for (const double error :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    table.add("explorer", error, error, error);
  }
  EXPECT_GE(table.quantiles().p50, TrackingTable::kMostErrorM);
  EXPECT_EQ(table.bins().size(), 1U);
}

TEST(TrackingTable, AFileWithNumbersBeyondTheTableIsRefusedWithItsLine) {
  const Scratch dir;
  const std::string head = "vehicle,speed_mps,acceleration_mps2,error_m,samples\nexplorer,1,1,0.01,3\n";
  for (const char* row : {"explorer,1e300,0,0,1", "explorer,0,-1,0,1", "explorer,0,0,1e8,1"}) {
    write_text(dir.path() / "tracking.csv", head + row + "\n");
    TrackingTable table;
    try {
      read_tracking(dir.path() / "tracking.csv", table);
      ADD_FAILURE() << row;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("tracking.csv:3: column '"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace skein::results
