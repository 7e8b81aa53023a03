#include "sim_server/process_faults.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace skein::sim {
namespace {

TEST(ProcessFaults, TheFaultsOfThePlanActAtEachExchange) {
  std::mt19937_64 random(5);
  const auto below = [&](std::uint64_t n) { return static_cast<double>(random() % n); };
  for (int round = 0; round < 100; ++round) {
    FaultPlan plan;
    for (int i = 0; i < 6; ++i) {
      Fault fault{.at_s = 0.1 * below(100), .until_s = {}, .action = Kill{std::to_string(i)}};
      if (i % 2 == 1) fault.action = Pause{std::to_string(i)};
      if (i % 3 > 0) fault.until_s = fault.at_s + 0.1 + 0.1 * below(50);
      plan.faults.push_back(fault);
    }
    plan.faults.push_back({.at_s = 0.0, .until_s = {}, .action = LidarFailure{"no process"}});

    ProcessFaults faults(plan);
    std::set<std::string> acting;
    for (Tick tick = 0; tick < ticks(20.0); tick += 20) {
      for (const auto& victim : faults.take_beginning(tick)) {
        EXPECT_TRUE(acting.insert(victim.member).second) << "began twice";
        const bool kill = std::stoi(victim.member) % 2 == 0;
        EXPECT_EQ(victim.killed, kill);
        EXPECT_EQ(victim.kind, kill ? "kill" : "pause");
      }
      for (int i = 0; i < 6; ++i) {
        const bool expected = plan.faults[static_cast<std::size_t>(i)].active(tick);
        EXPECT_EQ(acting.contains(std::to_string(i)), expected) << i << " at tick " << tick;
      }
      for (const auto& victim : faults.take_ending(tick + 20)) {
        EXPECT_EQ(acting.erase(victim.member), 1U) << "ended without a beginning";
        EXPECT_FALSE(plan.faults[std::stoul(victim.member)].active(tick + 20)) << "ended too early";
      }
    }
  }
}

// Faults that a viewer adds by hand begin during the run, and their ends become known later.
TEST(ProcessFaults, FaultsMayBeAddedAndEndedDuringTheRun) {
  FaultPlan plan;
  plan.faults.push_back({.at_s = 1.0, .until_s = 2.0, .action = Kill{"a"}});
  ProcessFaults faults(plan);
  EXPECT_TRUE(faults.take_beginning(ticks(0.5)).empty());
  for (int i = 0; i < 50; ++i) plan.faults.push_back({.at_s = 1.0, .until_s = {}, .action = LidarFailure{"other"}});
  plan.faults.push_back({.at_s = 1.0, .until_s = {}, .action = Pause{"b"}});
  EXPECT_TRUE(faults.take_ending(ticks(1.0)).empty());
  ASSERT_EQ(faults.take_beginning(ticks(1.0)).size(), 2U);
  EXPECT_TRUE(faults.take_beginning(ticks(1.05)).empty());
  plan.faults.back().until_s = 1.1;
  const auto ending = faults.take_ending(ticks(1.1));
  ASSERT_EQ(ending.size(), 1U);
  EXPECT_EQ(ending[0].member, "b");
  EXPECT_EQ(faults.take_ending(ticks(2.0)).size(), 1U);
}

}  // namespace
}  // namespace skein::sim
