// Faults by hand: for all requests in any order, the file that Skein writes has the same faults in the same exchanges.
#include "sim_server/hand_faults.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "core/faults/fault_writer.hpp"

namespace skein::sim {
namespace {

Scenario fleet() {
  Scenario scenario;
  scenario.name = "small";
  scenario.duration_s = 60.0;
  scenario.takeoff_timeout_s = 20.0;
  for (const char* name : {"jurong", "changi", "raffles"}) {
    UavConfig uav;
    uav.name = name;
    scenario.fleet.push_back(uav);
  }
  scenario.fleet[0].vehicle.lidar.emplace();
  return scenario;
}

class FaultsByHand : public testing::Test {
 protected:
  FaultsByHand()
      : file_(std::filesystem::temp_directory_path() / ("skein_by_hand_" + std::to_string(::getpid()) + ".yaml")) {}
  ~FaultsByHand() override { std::filesystem::remove(file_); }

  FaultPlan load(const std::string& text, std::uint64_t seed = 0) {
    std::ofstream(file_) << text;
    return load_fault_plan(file_, scenario_, seed);
  }
  static view::FaultOrder begin(const FaultAction& action, std::optional<double> for_s = {}) { return {action, for_s}; }
  static view::FaultOrder end(std::uint64_t number) { return {.ended = number}; }
  void expect_refused(HandFaults& hand, const view::FaultOrder& order, Tick next, const std::string& words) {
    const std::string before = hand.file_text(), reason = hand.obey(order, next);
    EXPECT_NE(reason.find(words), std::string::npos) << reason;
    EXPECT_EQ(hand.file_text(), before) << "a refused order must not change the file";
  }

  const Scenario scenario_ = fleet();
  const Tick period_ = scenario_.exchange_ticks();
  const std::filesystem::path file_;
};

/// Any fault that the viewer's page can request.
view::FaultOrder drawn(std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::vector<std::string> uavs = {"jurong", "changi", "raffles"};
  const std::string uav = uavs[below(3)];
  const std::vector<FaultAction> actions = {view::no_link(uav, uavs[below(3)]),
                                            view::no_link("gcs", uav),
                                            Blackout{uav},
                                            StationOutage{},
                                            Kill{below(2) == 0 ? uav : "comm_router"},
                                            Pause{below(2) == 0 ? uav : "station"},
                                            LidarFailure{uav},
                                            CameraFailure{uav},
                                            MotorFailure{uav, static_cast<int>(below(6)), 0.01 * double(below(99))},
                                            CommandDelay{uav, 1 + static_cast<int>(below(9))},
                                            OdometryFreeze{uav},
                                            StuckGimbal{uav}};
  view::FaultOrder order{.begins = actions[below(actions.size())]};
  if (below(3) == 0) order.for_s = 0.001 * static_cast<double>(50 + below(9000));
  return order;
}

TEST_F(FaultsByHand, TheWrittenFileHasTheSameFaultsInTheSameExchanges) {
  std::size_t done = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::mt19937_64 random(seed);
    const FaultPlan own = load(
        "faults: [{at_s: [8, 12], until_s: [20, 21], blackout: changi}, {at_s: [3, 30], for_s: [1, 2], kill: jurong},\n"
        "{when: time > 5 s, at_s: 4.51, until_s: 33.3, camera_failure: raffles},\n"
        "{at_s: 7, link: {loss: 0.3, burst_loss: {mean_good_s: 5, mean_burst_s: 1}}}]",
        seed);
    HandFaults hand(scenario_, own);
    std::map<Tick, std::vector<std::string>> flown;  // the faults in force in each exchange of the flight
    for (Tick next = period_; next < ticks(70.0); next += period_) {
      for (unsigned orders = random() % 40 == 0 ? 1 + random() % 4 : 0; orders > 0; --orders) {
        const bool ends = random() % 2 == 0;
        const std::string reason = hand.obey(ends ? end(random() % 20) : drawn(random), next);
        ++(reason.empty() ? done : refused);
      }
      for (const HandFault& one : hand.all()) {
        if (one.fault.active(next)) flown[next].push_back(fault_kind(one.fault) + " " + fault_target(one.fault));
      }
    }
    const FaultPlan read = load(hand.file_text(), seed + 1);  // nothing is left for a seed to draw
    ASSERT_EQ(read.faults.size(), own.faults.size() + hand.all().size());
    for (Tick tick = 0; tick < ticks(70.0); tick += period_) {
      std::vector<std::string> again;
      for (std::size_t i = 0; i < read.faults.size(); ++i) {
        const Fault& fault = read.faults[i];
        if (i < own.faults.size()) {
          EXPECT_EQ(fault.active(tick), own.faults[i].active(tick)) << i << " at tick " << tick;
        } else if (fault.active(tick)) {
          again.push_back(fault_kind(fault) + " " + fault_target(fault));
        }
      }
      ASSERT_EQ(again, flown[tick]) << "seed " << seed << " tick " << tick << "\n" << hand.file_text();
    }
    for (std::size_t i = 0; i < own.faults.size(); ++i)
      EXPECT_EQ(fault_line(read.faults[i]), fault_line(own.faults[i]));
  }
  EXPECT_GT(done, 500U);
  EXPECT_GT(refused, 500U);
}

TEST_F(FaultsByHand, AnInvalidFaultIsRefusedWithAReason) {
  HandFaults hand(scenario_, load("faults: [{at_s: 10, until_s: 20, blackout: changi}, {at_s: 1, link: {loss: 1}}]"));
  const Tick next = 100 * period_;  // 5 s
  expect_refused(hand, begin(Kill{"changy"}), next, "there is no program 'changy'; did you mean 'changi'?");
  expect_refused(hand, begin(Kill{"sim_server"}), next, "there is no program");
  expect_refused(hand, begin(LidarFailure{"changi"}), next, "'changi' has no LiDAR");
  expect_refused(hand, begin(view::no_link("changi", "nobody")), next, "there is no node 'nobody'");
  expect_refused(hand, begin(view::no_link("changi", "changi")), next, "between two nodes");
  expect_refused(hand, begin(Kill{"station"}), next, "no viewer could bring it back");
  expect_refused(hand, begin(Pause{"station"}), next, "no viewer could bring it back");
  expect_refused(hand, begin(Blackout{"changi"}), next, "the radio of changi has a fault from 10 s on already");
  expect_refused(hand, begin(Blackout{"jurong"}), ticks(80.0), "after the end");
  expect_refused(hand, end(0), next, "no such fault");

  EXPECT_EQ(hand.obey(begin(Blackout{"changi"}, 5.0), next), "") << "it ends when the fault of the file begins";
  EXPECT_EQ(hand.obey(begin(Kill{"jurong"}), next), "");
  EXPECT_EQ(hand.obey(begin(view::no_link("changi", "gcs")), next), "")
      << "in addition to the file's effect on this link";
  expect_refused(hand, begin(view::no_link("changi", "gcs")), next, "the link changi > gcs has a fault now already");
  EXPECT_EQ(hand.obey(begin(view::no_link("gcs", "changi")), next), "") << "the other direction is another link";
  expect_refused(hand, begin(Pause{"jurong"}), next + 50 * period_, "the process of jurong has a fault now already");
}

TEST_F(FaultsByHand, AFaultThatEndsBeforeItBeginsLeavesNothing) {
  HandFaults hand(scenario_, {});
  const Tick next = 40 * period_;
  EXPECT_EQ(hand.obey(begin(Kill{"jurong"}), next), "");
  ASSERT_EQ(hand.open(next).size(), 1U);
  EXPECT_EQ(hand.obey(end(hand.open(next)[0].number), next), "");
  EXPECT_TRUE(hand.empty());
  EXPECT_TRUE(load(hand.file_text()).empty());
  // No fault has its number now: a second request does not end another fault.
  EXPECT_EQ(hand.obey(begin(Kill{"changi"}), next), "");
  EXPECT_NE(hand.obey(end(0), next), "");
  EXPECT_EQ(hand.obey(end(1), next + period_), "");
  EXPECT_TRUE(hand.open(next + period_).empty());
  EXPECT_EQ(hand.all()[0].fault.end(), next + period_);
  EXPECT_NE(hand.obey(end(1), next + 2 * period_), "") << "it is over";
}

TEST_F(FaultsByHand, AFaultForAWhileMayEndSooner) {
  HandFaults hand(scenario_, {});
  EXPECT_EQ(hand.obey(begin(Kill{"station"}, 3.01), ticks(10.0)), "");
  EXPECT_EQ(*hand.all()[0].fault.end(), ticks(13.05)) << "whole exchanges";
  EXPECT_EQ(hand.obey(end(0), ticks(11.0)), "");
  EXPECT_EQ(*hand.all()[0].fault.end(), ticks(11.0));
}

TEST_F(FaultsByHand, AFaultMayBeginAndEndUpToTheEndOfTheRun) {
  HandFaults hand(scenario_, {});
  EXPECT_EQ(hand.obey(begin(CameraFailure{"changi"}), ticks(75.0)), "") << "take-off may have been at 19 s";
  EXPECT_EQ(hand.obey(end(0), ticks(78.0)), "");
  const FaultPlan read = load(hand.file_text());
  EXPECT_EQ(read.faults.at(0).begin(), ticks(75.0));
  EXPECT_EQ(read.faults.at(0).end(), ticks(78.0));
}

TEST_F(FaultsByHand, TheNumberOfFaultsByHandIsLimited) {
  HandFaults hand(scenario_, {});
  Tick next = period_;
  std::size_t taken = 0;
  for (; taken < 1000 && hand.obey(begin(StuckGimbal{"changi"}, 0.05), next).empty(); next += period_) ++taken;
  EXPECT_EQ(taken, 200U);
  expect_refused(hand, begin(StuckGimbal{"changi"}, 0.05), next, "at most 200 faults by hand");
}

}  // namespace
}  // namespace skein::sim
