// Faults by hand: whichever faults a viewer causes in a run, by-hand.yaml repeats the run bit for bit.
#include <algorithm>
#include <map>
#include <random>

#include "page_client.hpp"
#include "view_fixture.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

/// A flight in which UAVs deliver captures and exchange messages, so that faults of links and programs change the
/// digest.
const Arguments kBrokenFlight = {"towers", "--planner", "kios", "--duration", "60", "--no-oracle", "--no-report"};
const Arguments kWatched = {"--view", "--view-close", "--speed", "10"};

/// One fault of each kind that these tests need and four other random ones, in a random order.
std::vector<Json> drawn_faults(std::mt19937& random) {
  const auto uav = [&] { return kFleet[random() % kFleet.size()]; };
  const auto fault = [](const std::string& kind, Json more) {
    more["do"] = "fault";
    more["kind"] = kind;
    return more;
  };
  std::vector<Json> all = {
      fault("kill", {{"of", uav()}}), fault("kill", {{"of", "comm_router"}}),
      fault("kill", {{"of", "station"}, {"for_s", 1.0 + 0.01 * static_cast<double>(random() % 300)}}),
      fault("link", {{"from", uav()}, {"to", "gcs"}}), fault("camera_failure", {{"of", uav()}})};
  const std::vector<Json> others = {fault("pause", {{"of", uav()}}),
                                    fault("blackout", {{"of", uav()}}),
                                    fault("station_outage", Json::object()),
                                    fault("link", {{"from", "gcs"}, {"to", uav()}}),
                                    fault("lidar_failure", {{"of", "jurong"}}),
                                    fault("stuck_gimbal", {{"of", uav()}}),
                                    fault("odometry_freeze", {{"of", "sentosa"}}),
                                    fault("motor_failure", {{"of", uav()}, {"rotor", 2}, {"thrust", 0.9}}),
                                    fault("command_delay", {{"of", uav()}, {"exchanges", 3}})};
  for (int i = 0; i < 4; ++i) all.push_back(others[random() % others.size()]);
  std::ranges::shuffle(all, random);
  return all;
}

class FaultsByHand : public ViewTest {
 protected:
  static double time(const PageClient& page) { return page.state().is_null() ? 0.0 : page.state().value("t", 0.0); }
  static std::uint64_t done(const PageClient& page) { return page.state()["faults"]["done"]; }
  static std::uint64_t refused(const PageClient& page) { return page.state()["faults"]["refused"]; }

  /// Sends an order, and waits for the answer. @returns whether the server carried it out.
  static bool ask(PageClient& page, const Json& order) {
    const std::uint64_t before = done(page), refused_before = refused(page);
    page.ask(order);
    page.wait([&] { return done(page) != before || refused(page) != refused_before; });
    return done(page) != before;
  }

  /// Begins and ends faults until the run is over.
  static void meddle(PageClient& page, std::uint32_t seed) {
    std::mt19937 random(seed);
    double due_s = 12.0 + 0.01 * static_cast<double>(random() % 300);
    for (const Json& fault : drawn_faults(random)) {
      if (!page.wait([&] { return time(page) >= due_s; })) break;
      const bool holds = random() % 2 == 0;
      if (holds) page.ask({{"do", "pause"}});
      if (holds && !page.wait([&] { return page.state()["paused"] == true; })) break;
      ask(page, fault);
      const bool heard = fault.value("of", "") != "station";  // orders to a dying station may be lost
      if (heard && random() % 2 == 0 && !page.state()["faults"]["open"].empty()) {
        ask(page, {{"do", "end_fault"}, {"fault", page.state()["faults"]["open"][0]["n"]}});
      }
      if (holds) page.ask({{"do", "resume"}});
      due_s = time(page) + 1.0 + 0.01 * static_cast<double>(random() % 400);
    }
    page.wait([] { return false; });
  }

  void expect_named(const Json& result) {
    EXPECT_TRUE(result["deterministic"].get<bool>());
    EXPECT_NE(result["repeat_command"].get<std::string>().find("by-hand.yaml"), std::string::npos)
        << result["repeat_command"];
    std::map<std::string, int> open;
    for (const Json& one : result["interventions"]) {
      const std::string what = one["kind"].get<std::string>() + one["target"].get<std::string>();
      open[what] += one["what"] == "begin" ? 1 : -1;
      EXPECT_GE(open[what], 0) << one;
      EXPECT_DOUBLE_EQ(one["time_s"].get<double>(), 0.05 * one["step"].get<double>());
    }
    EXPECT_GE(result["interventions"].size(), 6U) << result["interventions"];
    EXPECT_TRUE(
        std::ranges::is_sorted(result["interventions"], {}, [](const Json& one) { return one["step"].get<int>(); }));
  }

  /// Expects by-hand.yaml to repeat a flight with faults by hand.
  void break_and_repeat(std::uint32_t seed, const Arguments& how, const Arguments& again) {
    SkeinRun& seen = start("seen", joined(joined(kBrokenFlight, how), kWatched));
    PageClient page(door_of(seen));
    meddle(page, seed);
    EXPECT_EQ(seen.exit_code(), 0) << seen.err();
    expect_complete_result(seen);
    expect_named(seen.result());
    SkeinRun& repeated = run("again", joined(joined(kBrokenFlight, again), {"--faults", seen.dir() / "by-hand.yaml"}));
    EXPECT_EQ(repeated.digest(), seen.digest()) << "seed " << seed << "\n" << seen.result()["interventions"].dump(1);
    EXPECT_TRUE(repeated.result()["interventions"].empty());
    ChildProcess& diff = skein({"diff", seen.dir(), repeated.dir()});
    EXPECT_EQ(diff.wait().code, 0) << diff.out() << diff.err();
    EXPECT_NE(run("unbroken", joined(kBrokenFlight, {"--one-process"})).digest(), seen.digest())
        << "the faults did not change the flight, so its repetition proves little";
  }
};

TEST_F(FaultsByHand, AreRepeatedInOneProcess) { break_and_repeat(1, {"--one-process"}, {"--one-process"}); }

TEST_F(FaultsByHand, OfAFleetOverCycloneDdsAreRepeated) { break_and_repeat(2, {}, {"--one-process"}); }

TEST_F(FaultsByHand, OfAFleetOverFastDdsAreRepeated) { break_and_repeat(3, {"--dds", "fastdds"}, {"--one-process"}); }

TEST_F(FaultsByHand, AreRepeatedByAFleetOverDds) { break_and_repeat(4, {"--one-process"}, {"--dds", "mixed"}); }

// The faults of the run's fault file come first, with the times that the seed drew, and its random losses are the same.
TEST_F(FaultsByHand, AreRepeatedTogetherWithThoseOfTheFaultFile) {
  const auto own = write("own.yaml",
                         "faults:\n  - {at_s: [13, 16], for_s: [3, 9], link: {loss: 0.4}}\n"
                         "  - {when: time > 20 s, for_s: [1, 2], camera_failure: raffles}\n");
  const Arguments flight = joined(kBrokenFlight, {"--seed", "5", "--one-process"});
  SkeinRun& seen = start("seen", joined(joined(flight, kWatched), {"--faults", own}));
  PageClient page(door_of(seen));
  ASSERT_TRUE(page.wait([&] { return time(page) > 14.0; }));
  page.ask({{"do", "pause"}});
  ASSERT_TRUE(page.wait([&] { return page.state()["paused"] == true; }));
  EXPECT_FALSE(ask(page, {{"do", "fault"}, {"kind", "camera_failure"}, {"of", "raffles"}}))
      << "a fault by hand must be refused while a fault of the file waits for the same camera";
  EXPECT_NE(page.state()["faults"]["why"].get<std::string>().find("the camera of raffles"), std::string::npos);
  EXPECT_TRUE(ask(page, {{"do", "fault"}, {"kind", "kill"}, {"of", "changi"}}));
  EXPECT_FALSE(page.state()["faults"]["open"][0]["begun"].get<bool>()) << "a fault must not begin before the next step";
  page.ask({{"do", "step"}});
  ASSERT_TRUE(page.wait([&] { return page.state()["faults"]["open"][0]["begun"] == true; }));
  EXPECT_TRUE(ask(page, {{"do", "end_fault"}, {"fault", page.state()["faults"]["open"][0]["n"]}}));
  page.ask({{"do", "resume"}});
  page.wait([] { return false; });
  EXPECT_EQ(seen.exit_code(), 0) << seen.err();
  const Json interventions = seen.result()["interventions"];
  ASSERT_EQ(interventions.size(), 2U) << interventions;
  EXPECT_EQ(interventions[1]["step"].get<int>(), interventions[0]["step"].get<int>() + 1)
      << "the run must have taken one step between the two";
  const Arguments again = joined(flight, {"--faults", seen.dir() / "by-hand.yaml"});
  EXPECT_EQ(run("again", again).digest(), seen.digest());
  EXPECT_NE(run("own", joined(flight, {"--faults", own})).digest(), seen.digest());
}

// While the station is dead, no viewer can resume a paused run.
TEST_F(FaultsByHand, AStationThatIsKilledWhileTheRunIsPausedComesBack) {
  SkeinRun& seen = start("seen", joined(joined(kBrokenFlight, {"--one-process"}), kWatched));
  PageClient page(door_of(seen));
  ASSERT_TRUE(page.wait([&] { return time(page) > 12.0; }));
  page.ask({{"do", "pause"}});
  ASSERT_TRUE(page.wait([&] { return page.state()["paused"] == true; }));
  EXPECT_FALSE(ask(page, {{"do", "fault"}, {"kind", "kill"}, {"of", "station"}}))
      << "the station must not be killed for good while the run is paused";
  const double held_s = time(page);
  EXPECT_TRUE(ask(page, {{"do", "fault"}, {"kind", "kill"}, {"of", "station"}, {"for_s", 2}}));
  page.ask({{"do", "step"}});
  ASSERT_TRUE(page.wait([&] { return time(page) >= held_s + 2.0; })) << "the station has not come back";
  ASSERT_TRUE(page.wait([&] { return page.state()["paused"] == true; }));
  const double back_s = time(page);
  EXPECT_LT(back_s, held_s + 2.5) << "the run did not pause again when the station came back";
  page.ask({{"do", "resume"}});
  page.wait([] { return false; });
  EXPECT_EQ(seen.exit_code(), 0) << seen.err();
}

TEST_F(FaultsByHand, AreInAValidFileAfterTheRunIsKilled) {
  SkeinRun& seen = start("seen", joined(joined(kBrokenFlight, {"--one-process"}), kWatched));
  PageClient page(door_of(seen));
  ASSERT_TRUE(page.wait([&] { return time(page) > 5.0; }));
  ASSERT_TRUE(ask(page, {{"do", "fault"}, {"kind", "link"}, {"from", "changi"}, {"to", "gcs"}}));
  seen.skein().signal(SIGINT);
  seen.skein().signal(SIGINT);
  seen.exit_code();
  ChildProcess& check = skein({"check", seen.dir() / "by-hand.yaml"});
  EXPECT_EQ(check.wait().code, 0) << check.err();
}

}  // namespace
}  // namespace skein::test
