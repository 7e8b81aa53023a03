// `skein run --debug UAV=gdb`: gdb gets the typed commands, the digest is the same as without gdb, and the fleet loses
// a program when the user leaves its gdb.
#include <map>
#include <regex>

#include "debug_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

const std::string kBreak = "break skein::agent::PatrolPlanner::plan\nrun\n";

class Gdb : public DebugTest {};

TEST_F(Gdb, BreaksInAPlannerPrintsAndFliesOnToTheSameDigest) {
  SKEIN_NEEDS_GDB();
  const ChildProcess& skein =
      fly("gdb", {"--debug", "changi=gdb"}, kBreak + "print in.k\nprint in.state.p_WB\nbt 4\ndelete\ncontinue\nquit\n");
  ASSERT_EQ(const_cast<ChildProcess&>(skein).wait().code, 0) << skein.out() << skein.err();
  const std::string said = skein.out();
  EXPECT_TRUE(std::regex_search(said, std::regex("\\$1 = [0-9]+\n"))) << said;
  EXPECT_TRUE(std::regex_search(said, std::regex("\\$2 = \\(-?[0-9.e-]+, -5[0-9.e-]*, [0-9.e-]+\\)\n"))) << said;
  EXPECT_TRUE(std::regex_search(said, std::regex("#0 .*PatrolPlanner::plan[^#]*patrol/patrol\\.cpp:[0-9]+"))) << said;
  EXPECT_TRUE(std::regex_search(said, std::regex("Agent::step[^#]*agent\\.cpp:[0-9]+"))) << said;
  EXPECT_EQ(result("gdb")["digest"], plain_digest());
  expect_part(text_of(dir("gdb") / "fleet.log"), "simulated 5");
  EXPECT_FALSE(text_of(dir("gdb") / "uav_agent-changi.report.json").empty());
}

TEST_F(Gdb, QuittingGdbEndsItsProgramAndTheFleetFliesOn) {
  SKEIN_NEEDS_GDB();
  ChildProcess& skein = fly("gdb", {"--debug", "changi=gdb"}, kBreak + "quit\n");
  EXPECT_EQ(skein.wait().code, 3) << skein.out() << skein.err();
  expect_only_lost("gdb", "changi");
  EXPECT_EQ(result("gdb")["status"], "completed");
  expect_part(skein.err() + text_of(dir("gdb") / "fleet.log"), "has ended; the fleet goes on without it");
}

TEST_F(Gdb, AProgramThatIsKilledInGdbIsLostAlthoughGdbStillRuns) {
  SKEIN_NEEDS_GDB();
  ChildProcess& skein = fly("gdb", {"--debug", "changi=gdb"},
                            kBreak + "kill\nshell while ! grep -q 'simulated [1-9]' " +
                                (dir("gdb") / "fleet.log").string() + "; do sleep 0.1; done\nquit\n");
  EXPECT_EQ(skein.wait().code, 3) << skein.out() << skein.err();
  expect_only_lost("gdb", "changi");
}

TEST_F(Gdb, TheFleetEndsWithItsServer) {
  SKEIN_NEEDS_GDB();
  ChildProcess& skein = fly("gdb", {"--debug", "sim_server=gdb"}, "quit\n");
  EXPECT_EQ(skein.wait().code, 3) << skein.out() << skein.err();
  expect_part(skein.err() + text_of(dir("gdb") / "fleet.log"), "the debugged program of sim_server has ended");
}

TEST_F(Gdb, BreakAtStopsInTheExchangeBeforeATime) {
  SKEIN_NEEDS_GDB();
  ChildProcess& skein =
      fly("gdb", {"--debug", "changi=gdb", "--break-at", "3.02"},
          "run\nbreak skein::agent::PatrolPlanner::plan\ncontinue\nprint in.tick\ndelete\ncontinue\n");
  EXPECT_EQ(skein.wait().code, 0) << skein.out() << skein.err();
  expect_part(skein.out(), "received signal SIGTRAP");
  expect_part(skein.out(), "$1 = 1200\n");  // 3.00 s
  EXPECT_EQ(result("gdb")["digest"], plain_digest());
}

// gdb runs in a folder in which the relative names of sources do not exist.
TEST_F(Gdb, GdbFindsTheSourceOfEveryPlanner) {
  SKEIN_NEEDS_GDB();
  std::string commands = "cd /\n";
  const std::map<std::string, std::string> planners = {
      {"FlockPlanner", "flock/flock"},        {"KiosPlanner", "kios/kios"}, {"PatrolPlanner", "patrol/patrol"},
      {"StarPlanner", "star/star"},           {"XxhPlanner", "xxh/xxh"},    {"HoverPlanner", "basic/hover"},
      {"WaypointsPlanner", "basic/waypoints"}};
  for (const auto& [planner, file] : planners) commands += "break " + planner + "::plan\nlist " + planner + "::plan\n";
  ChildProcess& gdb = typed(
      "gdb", {"gdb", "-nx", "-q", "-x", source_path("config/gdb/skein_printers.py"), program("uav_agent")}, commands);
  EXPECT_EQ(gdb.wait().code, 0) << gdb.err();
  for (const auto& [planner, file] : planners) {
    expect_part(gdb.out(), "file ./uav_agent/planners/" + file + ".cpp, line ");
    const std::string text = text_of(source_path("uav_agent/planners/" + file + ".cpp"));
    std::smatch head;
    ASSERT_TRUE(std::regex_search(text, head, std::regex("\n(.*\\bplan\\(const PlannerInput& .*\\{)\n"))) << file;
    expect_part(gdb.out(), "\t" + head[1].str());
  }
}

TEST_F(Gdb, GdbShowsThePlannersOutputInOneLine) {
  SKEIN_NEEDS_GDB();
  ChildProcess& skein = fly("gdb", {"--debug", "changi=gdb"}, kBreak + "finish\nkill\nquit\n", "1");
  skein.wait();
  expect_part(skein.out(), "Value returned is $1 = ");
  expect_part(skein.out(), "p_WB = (");
  EXPECT_EQ(skein.out().find("PlainObjectBase"), std::string::npos) << "gdb shows Eigen's internal members";
}

}  // namespace
}  // namespace skein::test
