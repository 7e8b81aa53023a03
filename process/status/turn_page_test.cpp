#include "process/status/turn_page.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

using Names = std::vector<std::string>;

TEST(TurnPage, TellsWhoHasATurnInEachSeat) {
  TurnPage launchers;
  TurnPage page(launchers.path());
  EXPECT_EQ(launchers.process(), page.process());
  EXPECT_EQ(launchers.holders(), Names{});
  page.enter(0, "sim_server");
  page.enter(7, "uav_agent-a");
  page.enter(TurnPage::kSeats - 1, "uav_agent-b");
  EXPECT_EQ(launchers.turns(7), 1U);
  EXPECT_EQ(launchers.holder(7), "uav_agent-a");
  EXPECT_EQ(launchers.holder(8), "");
  EXPECT_EQ(launchers.holders(), (Names{"sim_server", "uav_agent-a", "uav_agent-b"}));
  page.leave(0);
  page.leave(7);
  EXPECT_EQ(launchers.turns(7), 2U);
  EXPECT_EQ(launchers.holders(), (Names{"uav_agent-b"}));
}

TEST(TurnPage, WhoGaveTheReasonIsTheOne) {
  TurnPage launchers;
  TurnPage page(launchers.path());
  page.enter(1, "uav_agent-a");
  page.enter(2, "uav_agent-b");
  page.give_reason("closed what is not its own");
  EXPECT_EQ(launchers.reason(), "closed what is not its own");
  EXPECT_EQ(launchers.holders(), (Names{"uav_agent-a", "uav_agent-b"})) << "one of them";
  page.give_reason("says so itself", "uav_agent-b");
  EXPECT_EQ(launchers.holders(), (Names{"uav_agent-b"}));
  launchers.clear();
  EXPECT_EQ(launchers.holders(), Names{});
  EXPECT_EQ(launchers.reason(), "");
}

TEST(TurnPage, LongNamesAreCut) {
  TurnPage page;
  page.enter(0, std::string(1000, 'x'));
  const std::string holder = page.holder(0);
  EXPECT_FALSE(holder.empty());
  EXPECT_EQ(holder, std::string(holder.size(), 'x'));
}

}  // namespace
}  // namespace skein
