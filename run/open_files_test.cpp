#include "run/open_files.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"

namespace skein::cli {
namespace {

FleetPlan fleet_of_five(bool one_process) {
  FleetPlan plan;
  plan.options.one_process = one_process;
  plan.scenario.fleet.resize(5);
  for (const char* uav : {"a", "b", "c", "d", "e"}) plan.planners.push_back({uav, "hover"});
  return plan;
}

TEST(OpenFilesOfAFleet, ALimitThatIsTooLowIsNamedWithTheNeed) {
  for (const bool one_process : {false, true}) {
    const FleetPlan plan = fleet_of_five(one_process);
    const OpenFilesNeed need = open_files_need(plan);
    try {
      check_open_files(plan, 20);
      ADD_FAILURE() << "the fleet would fail in its middle";
    } catch (const InputError& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("a process may have 20 open files (ulimit -n)"), std::string::npos) << said;
      EXPECT_NE(said.find("`ulimit -n " + std::to_string(need.ample) + "`"), std::string::npos) << said;
    }
    EXPECT_THROW(check_open_files(plan, need.least - 1), InputError);
    EXPECT_NE(check_open_files(plan, need.least), "") << "a warning";
    EXPECT_NE(check_open_files(plan, need.ample - 1), "");
    EXPECT_EQ(check_open_files(plan, need.ample), "");
  }
}

/// With the programs of 5 UAVs, the launcher had 48 open files, and the server up to 73.
TEST(OpenFilesOfAFleet, TheNeedIsThatOfTheProcessWithMost) {
  const OpenFilesNeed need = open_files_need(fleet_of_five(false));
  EXPECT_GE(need.least, 48U);
  EXPECT_LE(need.least, 55U);
  EXPECT_GE(need.ample, 73U);
  EXPECT_LT(open_files_need(fleet_of_five(true)).ample, need.least) << "one process has no sockets";
}

/// The usual limit is 1024.
TEST(OpenFilesOfAFleet, TheLargestFleetMayStartWithTheUsualLimit) {
  FleetPlan plan;
  plan.scenario.fleet.resize(128);
  for (int uav = 0; uav < 128; ++uav) plan.planners.push_back({"uav" + std::to_string(uav), "hover"});
  EXPECT_NO_THROW(check_open_files(plan, 1024));
}

}  // namespace
}  // namespace skein::cli
