#include "cli/free_nodes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/types.hpp"
#include "results/from_nodes.hpp"

namespace skein::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<UavPlanner> kPlanners = {{"jurong", "ros"}, {"raffles", "ros:package/node"}, {"sentosa", "ros"}};

TEST(FreeNodes, AreThoseWithoutAPackage) {
  EXPECT_THAT(uavs_of_free_nodes(kPlanners), ElementsAre("jurong", "sentosa"));
}

TEST(FreeNodes, NeedAClockThatDoesNotWaitForThem) {
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

TEST(FreeNodes, AreToldOfByTopic) {
  const Json topic = {{"topic", "/jurong/command/trajectory"},
                      {"received", 100},
                      {"handed_on", 90},
                      {"late", 3},
                      {"lost", 7},
                      {"refused", 4},
                      {"other_clock", 2}};
  const Json uavs = {{{"name", "jurong"}, {"from_nodes", {topic}}},
                     {{"name", "raffles"}},
                     {{"name", "sentosa"}, {"from_nodes", Json::array()}}};
  EXPECT_EQ(results::free_nodes_table(uavs),
            "from ROS 2 nodes              received   handed on    late    lost   refused\n"
            "/jurong/command/trajectory         100          90       3       7         4\n");
  EXPECT_THAT(results::warnings_of_free_nodes(uavs),
              ElementsAre(HasSubstr("2 of 100 messages on /jurong/command/trajectory have stamps that are not"),
                          HasSubstr("sentosa: no ROS 2 node said anything")));
}

TEST(FreeNodes, NobodyIsToldOfWhereThereAreNone) {
  const Json uavs = {{{"name", "jurong"}}};
  EXPECT_EQ(results::free_nodes_table(uavs), "");
  EXPECT_TRUE(results::warnings_of_free_nodes(uavs).empty());
}

}  // namespace
}  // namespace skein::cli
