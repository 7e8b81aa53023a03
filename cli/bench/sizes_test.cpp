#include "cli/bench/sizes.hpp"

#include <gtest/gtest.h>

#include "core/scenario/scenario_reader.hpp"
#include "process/host/memory.hpp"

namespace skein::cli {
namespace {

std::vector<std::size_t> uavs_of(const BenchSizes& sizes) {
  std::vector<std::size_t> uavs;
  for (const BenchSize& fleet : sizes.fleets) uavs.push_back(fleet.uavs);
  return uavs;
}

TEST(BenchSizes, LargeFleetsAreMeasuredInOneProcessOnly) {
  const BenchSizes sizes = sizes_that_fit({1, 128, 129, 1000}, std::nullopt, true);
  EXPECT_EQ(uavs_of(sizes), (std::vector<std::size_t>{1, 128, 129, 1000}));
  for (const BenchSize& fleet : sizes.fleets) EXPECT_EQ(fleet.over_dds, fleet.uavs <= kMostUavsOverDds);
  EXPECT_EQ(sizes.said, (std::vector<std::string>{
                            "129 UAVs: measured in one process only, because over DDS a fleet has at most 128 UAVs",
                            "1000 UAVs: measured in one process only, because over DDS a fleet has at most 128 UAVs"}));
}

TEST(BenchSizes, TheProfileMeasuresNothingOverDds) {
  const BenchSizes sizes = sizes_that_fit({100, kMostUavs}, std::nullopt, false);
  EXPECT_EQ(uavs_of(sizes), (std::vector<std::size_t>{100, kMostUavs}));
  for (const BenchSize& fleet : sizes.fleets) EXPECT_FALSE(fleet.over_dds);
  EXPECT_TRUE(sizes.said.empty());
}

TEST(BenchSizes, AFleetThatDoesNotFitIntoMemoryIsLeftOutWithALine) {
  const BenchSizes sizes = sizes_that_fit({5, 1000, 20}, 1'000'000'000, false);
  EXPECT_EQ(uavs_of(sizes), (std::vector<std::size_t>{5, 20}));
  EXPECT_EQ(sizes.said, (std::vector<std::string>{"1000 UAVs: not measured, because in one process the fleet needs "
                                                  "about 15055 MB of memory, and this host has 1000 MB left"}));
}

/// The estimates for DDS and for one process decide separately. Tests fleets of 1 to 128 UAVs with little and much
/// memory.
TEST(BenchSizes, EachWayIsMeasuredIfItsEstimateFits) {
  for (std::size_t uavs = 1; uavs <= kMostUavsOverDds; ++uavs) {
    for (std::uint64_t left = 50'000'000; left < 1'400'000'000; left += 50'000'000) {
      const BenchSizes sizes = sizes_that_fit({uavs}, left, true);
      const bool one = one_process_memory(uavs) <= left, dds = fleet_memory(uavs) <= left;
      ASSERT_EQ(sizes.fleets.size(), one ? 1U : 0U) << uavs << " UAVs, " << left;
      EXPECT_EQ(one && sizes.fleets.front().over_dds, one && dds) << uavs << " UAVs, " << left;
      EXPECT_EQ(sizes.said.size(), one && dds ? 0U : 1U) << uavs << " UAVs, " << left;
    }
  }
}

}  // namespace
}  // namespace skein::cli
