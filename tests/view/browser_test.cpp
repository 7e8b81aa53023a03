// The page of a run in a browser, during the flight and afterwards. The scripts in this folder examine it.
#include <csignal>

#include "view_fixture.hpp"

namespace skein::test {
namespace {

class PageOfARun : public BrowserTest {
 protected:
  /// Expects a flight that a user watches, pauses and resumes to have the digest of the flight without a page.
  /// @param script  uses the page, up to the replay.
  void watch(const Arguments& flight, const Arguments& how, const std::string& script = "watch") {
    const std::string unseen = run("unseen", joined(flight, {"--one-process"})).digest();
    SkeinRun& seen = start("seen", joined(joined(flight, how), {"--view", "--pause-at", "0", "--speed", "1"}));
    const std::filesystem::path door = door_of(seen);
    look(script, door, seen.dir());
    seen.skein().signal(SIGINT);
    EXPECT_EQ(seen.exit_code(), 0) << seen.err();
    expect_complete_result(seen);
    EXPECT_EQ(seen.digest(), unseen);
    EXPECT_FALSE(std::filesystem::exists(door)) << "the file with the key was not deleted";
  }
};

const Arguments kWatchedFlight = {"towers", "--planner", "kios", "--duration", "60", "--no-oracle"};

/// A flight with the oracle's estimate, so that the page shows losses, too.
const Arguments kEstimatedFlight = {"towers", "--planner", "kios", "--duration", "60"};

TEST_F(PageOfARun, FollowsAFleetOverDds) { watch(kEstimatedFlight, {}); }

TEST_F(PageOfARun, FollowsAFleetInOneProcess) { watch(kEstimatedFlight, {"--one-process"}); }

TEST_F(PageOfARun, ShowsTheActivityOfUavsAndTheProgramForWhichARunWaits) {
  const std::string unseen = run("unseen", joined(kWatchedFlight, {"--one-process"})).digest();
  SkeinRun& seen = start("seen", joined(kWatchedFlight, {"--view", "--pause-at", "12", "--speed", "2"}));
  const std::filesystem::path door = door_of(seen);
  ASSERT_TRUE(seen.wait_until_flying()) << seen.err();
  look("activity", door, seen.dir(), {"jurong", std::to_string(processes_of(seen.dir()).at("uav_agent-jurong"))});
  seen.skein().signal(SIGINT);
  EXPECT_EQ(seen.exit_code(), 0) << seen.err();
  EXPECT_EQ(seen.digest(), unseen) << "a program that was stopped for a while counts as lost, or changed the flight";
}

TEST_F(PageOfARun, ShowsPointsAndMapsOverDds) { watch(kWatchedFlight, {"--dds", "mixed"}, "clouds"); }

TEST_F(PageOfARun, ShowsPointsAndMapsInOneProcess) { watch(kWatchedFlight, {"--one-process"}, "clouds"); }

TEST_F(PageOfARun, ReconnectsToAStationThatWasKilled) {
  const auto faults = write("faults.yaml", "faults:\n  - {at_s: 16, until_s: 18, kill: station}\n");
  for (const Arguments& how : {Arguments{"--one-process"}, Arguments{}}) {
    const std::string name = how.empty() ? "dds" : "one";
    SkeinRun& seen = start(
        name, joined(joined(kWatchedFlight, how), {"--faults", faults, "--view", "--pause-at", "15", "--speed", "1"}));
    look("reconnect", door_of(seen), seen.dir());
    seen.skein().signal(SIGINT);
    EXPECT_EQ(seen.exit_code(), 0) << seen.err();
  }
}

// Buttons of the page cause faults; the file with these faults must repeat the flight.
TEST_F(PageOfARun, CausesFaultsByItsButtons) {
  for (const Arguments& how : {Arguments{"--one-process"}, Arguments{}}) {
    const std::string name = how.empty() ? "dds" : "one";
    SkeinRun& seen = start(name, joined(joined(kWatchedFlight, how), {"--view", "--pause-at", "12", "--speed", "2"}));
    look("by_hand", door_of(seen), seen.dir());
    seen.skein().signal(SIGINT);
    EXPECT_EQ(seen.exit_code(), 0) << seen.err();
    expect_complete_result(seen);
    const Arguments again = {"--one-process", "--faults", seen.dir() / "by-hand.yaml"};
    EXPECT_EQ(run(name + "_again", joined(kWatchedFlight, again)).digest(), seen.digest());
  }
}

// The browser reaches the page as from another machine with `ssh -L`.
TEST_F(PageOfARun, WorksThroughATunnelWithAnotherPort) {
  SkeinRun& seen =
      start("seen", joined(kWatchedFlight, {"--one-process", "--view", "--pause-at", "5", "--speed", "2"}));
  look("tunnel", door_of(seen), seen.dir());
  seen.skein().signal(SIGINT);
  EXPECT_TRUE(seen.exit_code() == 0 || seen.exit_code() == 130) << seen.err();
}

TEST_F(PageOfARun, ShowsAFinishedRun) {
  const SkeinRun& done =
      run("done", {"towers", "--planner", "kios", "--seed", "3", "--duration", "60", "--one-process"});
  ChildProcess& replay = start_program("replay", {program("skein"), "replay", done.dir()});
  ASSERT_TRUE(eventually([&] { return !door_in(replay.out()).empty(); })) << replay.err();
  look("replay", door_in(replay.out()), done.dir());
  replay.signal(SIGINT);
  EXPECT_EQ(replay.wait().code, 0) << replay.err();
}

}  // namespace
}  // namespace skein::test
