#include "run/free_nodes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/types.hpp"

namespace skein::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<UavPlanner> kPlanners = {{"jurong", "ros"}, {"raffles", "ros:package/node"}, {"sentosa", "ros"}};

TEST(FreeNodes, AreForTheUavsWhosePlannerNamesNoPackage) {
  EXPECT_THAT(uavs_of_free_nodes(kPlanners), ElementsAre("jurong", "sentosa"));
}

TEST(FreeNodes, NeedTheRealtimeClock) {
  for (const char* clock : {"realtime", "realtime:0.5"}) EXPECT_NO_THROW(check_free_nodes(kPlanners, clock));
  EXPECT_NO_THROW(check_free_nodes({{"jurong", "ros:package/node"}}, "lockstep"));
  try {
    check_free_nodes(kPlanners, "lockstep");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--planner jurong=ros: "));
    EXPECT_THAT(error.what(), HasSubstr("--clock realtime"));
    EXPECT_THAT(error.what(), HasSubstr("jurong=ros:PACKAGE/EXECUTABLE"));
  }
}

}  // namespace
}  // namespace skein::cli
