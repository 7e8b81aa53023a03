// Which capture reports the station must have received, for hand-made records of the server.
#include "signals/custody.hpp"

#include <gtest/gtest.h>

namespace skein::signals {
namespace {

using Deliveries = std::map<CaptureKey, std::uint64_t>;

class CustodyTest : public testing::Test {
 protected:
  CustodyTest() {
    UavConfig uav;
    uav.name = "alpha";
    scenario_.fleet.push_back(uav);
    run_.result = {{"sim_time_s", 10.0}, {"score", 0.0}};  // 200 steps
    for (const char* member : {"alpha", "station", "comm_router"}) event(0, "joined", member);
  }

  void event(std::uint64_t step, const std::string& what, const std::string& subject, const std::string& object = "") {
    run_.events.push_back({step, what, subject, object});
  }
  void link(std::uint64_t up, std::uint64_t down) {
    event(up, "link_up", "alpha", "gcs");
    event(down, "link_down", "alpha", "gcs");
  }
  void captured(std::uint64_t step, std::uint64_t capture) {
    event(step, "captured", "alpha", std::to_string(capture));
  }
  void fault(double at_s, double until_s, FaultAction action) { plan_.faults.push_back({at_s, until_s, action}); }
  Deliveries derived() const { return derived_deliveries(run_, scenario_, plan_); }
  static Deliveries first(std::uint64_t step) { return {{{"alpha", 0}, step}}; }

  results::RunRecord run_;
  Scenario scenario_;
  FaultPlan plan_;
};

TEST_F(CustodyTest, AReportArrivesInTheStepAfterTheFirstWithALink) {
  captured(20, 0);
  link(0, 100);
  EXPECT_EQ(derived(), first(21));
}

TEST_F(CustodyTest, WithoutALinkAReportWaits) {
  captured(20, 0);
  EXPECT_EQ(derived(), Deliveries());
  link(150, 151);
  EXPECT_EQ(derived(), first(151));
}

TEST_F(CustodyTest, AReportOnItsWayAtTheEndOfTheRunIsLost) {
  captured(200, 0);
  link(0, 300);
  EXPECT_EQ(derived(), Deliveries());
}

TEST_F(CustodyTest, ACaptureThatALinkLosesIsSentAgainAfterTenSteps) {
  captured(20, 0);
  link(0, 300);
  run_.messages = {{20, "alpha", std::nullopt}, {30, "alpha", std::nullopt}};
  EXPECT_EQ(derived(), first(41));
}

TEST_F(CustodyTest, OfSeveralCopiesOnTheirWayTheFirstToArriveCounts) {
  captured(20, 0);
  link(0, 300);
  run_.messages = {{20, "alpha", 60}, {30, "alpha", 36}};
  EXPECT_EQ(derived(), first(36));
}

TEST_F(CustodyTest, AReportWaitsForLinksRouterAndStation) {
  captured(20, 0);
  link(0, 300);
  fault(1.0, 1.5, StationOutage{});  // steps 20 to 29
  EXPECT_EQ(derived(), first(31));
  event(30, "left", "comm_router");
  event(35, "joined", "comm_router");
  EXPECT_EQ(derived(), first(41));
  event(41, "left", "station");
  event(49, "joined", "station");
  EXPECT_EQ(derived(), first(51));
}

TEST_F(CustodyTest, NothingIsKeptForAStationThatIsAboutToComeBack) {
  captured(20, 0);
  link(0, 300);
  event(15, "left", "station");
  event(21, "joined", "station");
  EXPECT_EQ(derived(), first(31));
}

TEST_F(CustodyTest, AKilledRouterLosesTheMessagesThatWaitInIt) {
  captured(20, 0);
  link(0, 300);
  run_.messages = {{20, "alpha", 45}, {30, "alpha", 44}, {40, "alpha", std::nullopt}};
  event(35, "left", "comm_router");
  event(38, "joined", "comm_router");
  EXPECT_EQ(derived(), first(51));
}

TEST_F(CustodyTest, ARestartedAgentSendsAtOnceAndAResumedOneTenStepsAfterItsLastAttempt) {
  captured(20, 0);
  link(0, 300);
  run_.messages = {{20, "alpha", std::nullopt}};
  event(22, "left", "alpha");
  event(25, "joined", "alpha");
  EXPECT_EQ(derived(), first(26));
  fault(1.1, 1.25, Pause{"alpha"});
  EXPECT_EQ(derived(), first(31));
}

TEST_F(CustodyTest, ACaptureTakenWhileTheAgentIsAwayIsHandedOutLater) {
  link(0, 300);
  event(15, "left", "alpha");
  captured(20, 0);
  event(25, "joined", "alpha");
  EXPECT_EQ(derived(), first(26));
  fault(0.75, 1.25, Pause{"alpha"});
  EXPECT_EQ(derived(), first(26));
}

TEST_F(CustodyTest, AFaultThatWaitedActsFromItsBeginningOn) {
  captured(20, 0);
  link(0, 300);
  plan_.faults.push_back({.at_s = 0.5, .until_s = 1.5, .action = StationOutage{}, .waits = true});
  EXPECT_EQ(derived(), first(21)) << "the waiting fault has not begun";
  run_.result["faults"] = Json::array({{{"began_step", 20}}});
  EXPECT_EQ(derived(), first(31));
}

}  // namespace
}  // namespace skein::signals
