#include "run/open_files.hpp"

#include <gtest/gtest.h>
#include <sys/select.h>

#include <map>
#include <string>

#include "core/types.hpp"
#include "tests/support/limited_files.hpp"

namespace skein::cli {
namespace {

FleetPlan fleet_of_five(bool one_process) {
  FleetPlan plan;
  plan.options.one_process = one_process;
  plan.scenario.fleet.resize(5);
  for (const char* uav : {"a", "b", "c", "d", "e"}) plan.planners.push_back({uav, "hover"});
  return plan;
}

std::string judge(const FleetPlan& plan, std::uint64_t limit) {
  return judge_open_files_limit("the fleet", open_files_need(plan), limit);
}

TEST(OpenFilesOfAFleet, ALimitThatIsTooLowIsNamedWithTheNeed) {
  for (const bool one_process : {false, true}) {
    const FleetPlan plan = fleet_of_five(one_process);
    const OpenFilesNeed need = open_files_need(plan);
    try {
      judge(plan, 20);
      ADD_FAILURE() << "accepted, although the fleet would fail in flight";
    } catch (const InputError& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("a process may have 20 open files (ulimit -n)"), std::string::npos) << said;
      EXPECT_NE(said.find("`ulimit -n " + std::to_string(need.ample) + "`"), std::string::npos) << said;
    }
    EXPECT_THROW(judge(plan, need.least - 1), InputError);
    EXPECT_NE(judge(plan, need.least), "") << "the least limit gives a warning";
    EXPECT_NE(judge(plan, need.ample - 1), "");
    EXPECT_EQ(judge(plan, need.ample), "");
  }
}

/// Measured with 5 UAVs: the launcher had 48 open files; the server had 64 over Cyclone DDS and 74 over Fast DDS,
/// and ended with two fewer.
TEST(OpenFilesOfAFleet, TheNeedIsThatOfTheProcessWithMostFiles) {
  FleetPlan plan = fleet_of_five(false);
  for (const auto& [vendors, files] : std::map<std::string, std::uint64_t>{{"cyclonedds", 64}, {"fastdds", 74}}) {
    plan.options.dds = vendors;
    const OpenFilesNeed need = open_files_need(plan);
    EXPECT_GE(need.least, files);
    EXPECT_LE(need.least, files + 5) << "a fleet that can fly must not be refused";
    EXPECT_GT(need.ample, need.least);
    EXPECT_LT(open_files_need(fleet_of_five(true)).ample, need.least) << "a fleet in one process needs no sockets";
  }
  plan.options.dds = "mixed";
  EXPECT_GE(open_files_need(plan).least, 71U) << "the router needs most files over Fast DDS";
}

/// Measured: the process of 5 UAVs had 25 open files without a recording, 30 with one, and 33 with maps, too.
TEST(OpenFilesOfAFleet, OneProcessNeedsMoreFilesForRecordingsAndMaps) {
  FleetPlan plan = fleet_of_five(true);
  plan.options.record = "none";
  EXPECT_EQ(open_files_need(plan).least, 25U);
  plan.options.record = "run";
  EXPECT_EQ(open_files_need(plan).least, 30U);
  plan.options.keep_maps_s = 10.0;
  EXPECT_GE(open_files_need(plan).least, 33U);
}

TEST(OpenFilesOfAFleet, ALowLimitIsRaisedToTheNeed) {
  for (const bool one_process : {false, true}) {
    const FleetPlan plan = fleet_of_five(one_process);
    const LimitedOpenFiles low(24);
    EXPECT_EQ(allow_open_files(plan), "");
    EXPECT_EQ(open_files_limit(), open_files_need(plan).ample);
  }
}

TEST(OpenFilesOfAFleet, TheServersOfAFleetOnSeveralHostsNeedAsMany) {
  FleetPlan plan = fleet_of_five(false);
  plan.options.place.at = "a=host1,b=host2";
  const std::string said = done_with_open_files(60, [&] { return "accepted: " + allow_open_files(plan); });
  EXPECT_EQ(said.find("a process may have 60 open files"), 0U) << said;
}

TEST(OpenFilesOfAFleet, InContainersOnlyTheFilesOfTheLauncherCount) {
  const FleetPlan plan = fleet_of_five(false);
  const auto said_with = [&](rlim_t files) {
    return done_with_open_files(files, [&] {
      allow_launcher_open_files(plan);
      return std::string("accepted");
    });
  };
  EXPECT_EQ(said_with(60), "accepted");
  const std::string said = said_with(30);
  EXPECT_NE(said.find("the launcher of a fleet of 5 UAVs needs about 49"), std::string::npos) << said;
  const LimitedOpenFiles low(30);
  EXPECT_NO_THROW(allow_launcher_open_files(plan)) << "the launcher may raise its limit";
}

/// The usual limit is 1024, and Cyclone DDS calls select(), which aborts the program at greater descriptors.
TEST(OpenFilesOfAFleet, OnlyOverFastDdsALargeFleetNeedsMoreThanTheUsualLimit) {
  FleetPlan plan;
  plan.scenario.fleet.resize(128);
  for (int uav = 0; uav < 128; ++uav) plan.planners.push_back({"uav" + std::to_string(uav), "hover"});
  EXPECT_LT(open_files_need(plan).least, std::uint64_t{FD_SETSIZE});
  EXPECT_NO_THROW(judge(plan, 1024));
  plan.options.dds = "fastdds";
  EXPECT_THROW(judge(plan, 1024), InputError);
}

}  // namespace
}  // namespace skein::cli
