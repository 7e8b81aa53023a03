#include "run/memory_need.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/types.hpp"
#include "process/host/memory.hpp"

namespace skein::cli {
namespace {

FleetPlan fleet_for_memory(int uavs, bool one_process) {
  FleetPlan plan;
  plan.options.one_process = one_process;
  plan.scenario.fleet.resize(static_cast<std::size_t>(uavs));
  for (int uav = 0; uav < uavs; ++uav) plan.planners.push_back({"uav" + std::to_string(uav), "hover"});
  return plan;
}

TEST(MemoryOfAFleet, AFleetThatDoesNotFitIsRefusedWithTheEstimate) {
  for (const bool one_process : {false, true}) {
    const FleetPlan plan = fleet_for_memory(100, one_process);
    const std::uint64_t need = memory_need(plan);
    EXPECT_NO_THROW(check_memory(plan, need));
    EXPECT_NO_THROW(check_memory(plan, std::nullopt)) << "nothing is refused if the free memory is unknown";
    try {
      check_memory(plan, need - 1'000'000);
      ADD_FAILURE() << "accepted, although the system would kill the fleet in flight";
    } catch (const InputError& error) {
      const std::string said = error.what(), megabytes = std::to_string(need / 1'000'000);
      EXPECT_EQ(said.find("a fleet of 100 UAVs needs about " + megabytes + " MB of memory"), 0U) << said;
      EXPECT_NE(said.find(std::to_string(need / 1'000'000 - 1) + " MB left"), std::string::npos) << said;
      EXPECT_EQ(said.find("--one-process") == std::string::npos, one_process) << said;
    }
  }
}

TEST(MemoryOfAFleet, MoreUavsNeedMoreMemoryAndOneProcessNeedsLess) {
  for (int uavs = 1; uavs < 128; ++uavs) {
    EXPECT_LT(memory_need(fleet_for_memory(uavs, false)), memory_need(fleet_for_memory(uavs + 1, false)));
    EXPECT_LT(memory_need(fleet_for_memory(uavs, true)), memory_need(fleet_for_memory(uavs, false)));
  }
}

TEST(MemoryOfAFleet, FleetsOnSeveralHostsAreNotChecked) {
  FleetPlan plan = fleet_for_memory(5, false);
  plan.options.place.at = "uav0=host1,uav1=host2";
  EXPECT_NO_THROW(check_memory(plan, 0));
}

TEST(MemoryOfAFleet, TheFreeMemoryOfThisHostIsRead) {
  const auto left = memory_left();
  ASSERT_TRUE(left);
  EXPECT_GT(*left, 1'000'000U);
}

}  // namespace
}  // namespace skein::cli
