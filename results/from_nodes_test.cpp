#include "results/from_nodes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skein::results {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(FromNodes, TheTableHasALineForEachTopic) {
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
  EXPECT_EQ(free_nodes_table(uavs),
            "from ROS 2 nodes              received   handed on    late    lost   refused\n"
            "/jurong/command/trajectory         100          90       3       7         4\n");
  EXPECT_THAT(warnings_of_free_nodes(uavs),
              ElementsAre(HasSubstr("2 of 100 messages on /jurong/command/trajectory have time stamps from"),
                          HasSubstr("sentosa: no ROS 2 node sent anything")));
}

TEST(FromNodes, WithoutRos2NodesThereIsNoTable) {
  const Json uavs = {{{"name", "jurong"}}};
  EXPECT_EQ(free_nodes_table(uavs), "");
  EXPECT_TRUE(warnings_of_free_nodes(uavs).empty());
}

}  // namespace
}  // namespace skein::results
