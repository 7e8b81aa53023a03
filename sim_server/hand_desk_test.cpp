#include "sim_server/hand_desk.hpp"

#include <gtest/gtest.h>

namespace skein::sim {
namespace {

using std::chrono::milliseconds;

constexpr UavIndex kFirst{0}, kSecond{1}, kThird{2};

Scenario fleet_of_three() {
  Scenario scenario;
  for (const char* name : {"ann", "bob", "cid"}) {
    UavConfig uav;
    uav.name = name;
    scenario.fleet.push_back(uav);
  }
  return scenario;
}

class HandDeskTest : public testing::Test {
 protected:
  static view::FlyOrder ahead(const std::string& uav, double mps) { return {uav, {.velocity = {mps, 0.0, 0.0}}}; }

  Scenario scenario_ = fleet_of_three();
  HandDesk desk_{scenario_, {kFirst, kThird}};
  HandDesk::Clock::time_point now_{std::chrono::hours(1)};
};

TEST_F(HandDeskTest, TheDeskReportsEachChangeOnce) {
  EXPECT_EQ(desk_.news(kFirst, now_), std::nullopt) << "no viewer has sent a command yet";
  desk_.take(ahead("ann", 1.0), now_);
  desk_.take(ahead("ann", 2.0), now_);
  desk_.take(ahead("cid", 3.0), now_);
  EXPECT_EQ(desk_.news(kFirst, now_), ahead("", 2.0).command) << "the newest counts";
  EXPECT_EQ(desk_.news(kFirst, now_), std::nullopt);
  desk_.take(ahead("ann", 2.0), now_);
  EXPECT_EQ(desk_.news(kFirst, now_), std::nullopt) << "a renewed command is no change";
  EXPECT_EQ(desk_.news(kThird, now_), ahead("", 3.0).command);
}

TEST_F(HandDeskTest, ACommandThatIsNotRenewedEnds) {
  desk_.take(ahead("ann", 2.0), now_);
  EXPECT_TRUE(desk_.news(kFirst, now_));
  for (int i = 0; i < 20; ++i) {
    now_ += HandDesk::kHolds - milliseconds(1);
    EXPECT_EQ(desk_.news(kFirst, now_), std::nullopt) << "it is held";
    desk_.take(ahead("ann", 2.0), now_);
  }
  now_ += HandDesk::kHolds;
  EXPECT_EQ(desk_.news(kFirst, now_), HandCommand{}) << "the browser has gone: the UAV comes to rest";
  now_ += HandDesk::kHolds;
  EXPECT_EQ(desk_.news(kFirst, now_), std::nullopt);
  desk_.take(ahead("ann", 2.0), now_);
  EXPECT_EQ(desk_.news(kFirst, now_), ahead("", 2.0).command) << "it is back";
}

/// Much time passes between two steps when the run is paused.
TEST_F(HandDeskTest, ACommandThatEndedBeforeTheNextStepNeverActs) {
  desk_.take(ahead("ann", 2.0), now_);
  now_ += std::chrono::minutes(1);
  EXPECT_EQ(desk_.news(kFirst, now_), std::nullopt);
}

TEST_F(HandDeskTest, OrdersForUavsThatAreNotFlownByHandAreIgnored) {
  for (const char* uav : {"bob", "dan", ""}) desk_.take(ahead(uav, 1.0), now_);
  for (const UavIndex uav : {kFirst, kSecond, kThird}) EXPECT_EQ(desk_.news(uav, now_), std::nullopt);
}

}  // namespace
}  // namespace skein::sim
