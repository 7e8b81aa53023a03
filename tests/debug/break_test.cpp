// `--break-on`: the debugger stops where an event happened to its UAV, and the flight continues to the same digest.
// Also: a recorded flight of one UAV in gdb.
#include <cmath>

#include "debug_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

/// Commands of gdb: run to SIGTRAP, then to the planner, then to the end.
std::string look_once(const std::string& planner) {
  return "run\nbreak skein::agent::" + planner + "::plan\ncontinue\nprint in.tick\ndelete\ncontinue\n";
}

class Break : public DebugTest {
 protected:
  /// Ticks of 2.5 ms of the last exchange (50 ms) before a time.
  static long last_exchange_before(double time_s) {
    return 20 * static_cast<long>(std::ceil(time_s / 0.05 - 1e-6) - 1);
  }
  /// Flies in gdb, which must stop once, in the last exchange before `time_s`. The digest must be that of `plain`.
  void expect_stop(const std::string& name, const Arguments& flight, const std::string& planner, double time_s,
                   const SkeinRun& plain) {
    const Arguments words = joined({"skein", "run", "--debug", "changi=gdb", "--out", dir(name)}, flight);
    ChildProcess& skein = typed(name, words, look_once(planner));
    EXPECT_EQ(skein.wait().code, 0) << skein.out() << skein.err();
    const std::string said = skein.out();
    expect_part(said, "received signal SIGTRAP");
    EXPECT_EQ(said.find("SIGTRAP"), said.rfind("SIGTRAP")) << "the program stopped more than once";
    expect_part(said, "$1 = " + std::to_string(last_exchange_before(time_s)) + "\n");
    expect_part(said, "exited normally");
    EXPECT_EQ(result(name)["digest"], plain.digest());
    EXPECT_TRUE(result(name)["deterministic"]);
  }
};

TEST_F(Break, TheDebuggerStopsInTheExchangeBeforeACollision) {
  SKEIN_NEEDS_GDB();
  const Arguments flight = {scenario_,
                            "--agent",
                            helper_program("crash_agent"),
                            "--planner",
                            "hover,changi=crash:at_s=2,rams=true",
                            "--duration",
                            "8",
                            "--no-oracle"};
  SkeinRun& plain = run("plain", joined(flight, {"--one-process"}));
  const Json collisions = plain.result()["collisions"];
  ASSERT_EQ(collisions.size(), 1u) << collisions;
  ASSERT_EQ(collisions[0]["uav"], "changi");
  expect_stop("stopped", joined(flight, {"--break-on", "collision"}), "CrashPlanner",
              collisions[0]["time_s"].get<double>(), plain);
}

TEST_F(Break, TheDebuggerStopsInTheExchangeBeforeAFaultOfItsUav) {
  SKEIN_NEEDS_GDB();
  const std::string faults = write("faults.yaml",
                                   "faults:\n"
                                   "  - {at_s: 1.5, until_s: 2.5, lidar_failure: jurong}\n"
                                   "  - {at_s: 3.3, until_s: 4, camera_failure: changi}\n");
  const Arguments flight = {scenario_, "--planner", "patrol", "--faults", faults, "--duration", "5", "--no-oracle"};
  SkeinRun& plain = run("plain", joined(flight, {"--one-process"}));
  expect_stop("stopped", joined(flight, {"--break-on", "fault", "--break-from", plain.dir()}), "PatrolPlanner", 3.3,
              plain);
  ChildProcess& never = typed("never",
                              joined({"skein", "run", "--debug", "changi=gdb", "--break-on", "rejected", "--break-from",
                                      plain.dir(), "--out", dir("never")},
                                     flight),
                              "quit\n");
  EXPECT_EQ(never.wait().code, 2);
  expect_part(never.err(), "--break-on rejected: it never happened to changi");
  EXPECT_FALSE(std::filesystem::exists(dir("never")));
}

TEST_F(Break, ARecordedUavIsDebuggedAloneAndSendsTheSameMessages) {
  SKEIN_NEEDS_GDB();
  SkeinRun& flown = run("flown", {scenario_, "--planner", "patrol", "--duration", "5", "--no-oracle", "--one-process"});
  ChildProcess& again =
      typed("again", {"skein", "rerun", flown.dir(), "--uav", "changi", "--debug", "changi=gdb", "--out", dir("again")},
            "break skein::agent::PatrolPlanner::plan if in.k == 60\nrun\nprint in.k\nprint in.state.p_WB\n"
            "delete\ncontinue\nquit\n");
  EXPECT_EQ(again.wait().code, 0) << again.out() << again.err();
  expect_part(again.out(), "hit Breakpoint 1, skein::agent::PatrolPlanner::plan");
  expect_part(again.out(), "$1 = 60\n");
  expect_part(again.out(), "$2 = (");
  expect_part(again.out(), "changi: the output is the recorded one\n");
  EXPECT_EQ(result("again")["digest"], flown.digest());
}

}  // namespace
}  // namespace skein::test
