// `skein ps` and `skein attach`: debugging in a fleet that already flies.
#include <sys/socket.h>

#include "debug_fixture.hpp"
#include "process/host/host_lock.hpp"

namespace skein::test {
namespace {

class Attach : public DebugTest {
 protected:
  SkeinRun& flying_fleet() {
    SkeinRun& fleet = start("fleet", {scenario_, "--planner", "patrol", "--duration", "600", "--no-oracle"});
    EXPECT_TRUE(fleet.wait_until_flying()) << fleet.err();
    return fleet;
  }
  static void end(SkeinRun& fleet) {
    fleet.skein().signal(SIGINT);
    EXPECT_EQ(fleet.exit_code(), 130) << fleet.err();
    EXPECT_TRUE(fleet.result()["lost_members"].empty()) << fleet.result()["lost_members"];
  }
};

TEST_F(Attach, PsListsTheFleetAndItsPrograms) {
  SkeinRun& fleet = flying_fleet();
  const std::string text = skein({"ps"}).out();
  const std::size_t at = text.find(std::filesystem::path(fleet.dir()).filename().string() + ": scenario, simulated ");
  ASSERT_NE(at, std::string::npos) << text;
  expect_part(text, "launcher " + std::to_string(fleet.skein().pid()) + "\n");
  for (const auto& [program, pid] : processes_of(fleet.dir())) {
    if (program == "skein") continue;
    expect_part(text, "  " + program);
    expect_part(text, std::to_string(pid) + "  runs\n");
  }
  end(fleet);
}

// Each look takes a place in the queue of the lock of the fleet's domain, which has at most SOMAXCONN places.
TEST_F(Attach, TheLauncherIsFoundHoweverOftenAUserLooks) {
  SkeinRun& fleet = flying_fleet();
  const std::string lock = domain_lock_name(fleet.domains().first);
  const auto is_found = [&] { return HostLock::holder(lock) == fleet.skein().pid(); };
  for (int look = 0; look < 3 * SOMAXCONN; ++look) ASSERT_TRUE(is_found() || eventually(is_found)) << look;
  end(fleet);
}

TEST_F(Attach, GdbInspectsAFlyingProgramWhichThenFliesOn) {
  SKEIN_NEEDS_GDB();
  SkeinRun& fleet = flying_fleet();
  ChildProcess& gdb = typed("gdb", {"skein", "attach", "changi", "--run", fleet.dir()},
                            "break skein::agent::PatrolPlanner::plan\ncontinue\nprint in.state.p_WB\ndetach\nquit\n");
  EXPECT_EQ(gdb.wait().code, 0) << gdb.out() << gdb.err();
  expect_part(gdb.out(), "$1 = (");
  expect_part(gdb.err(), "while changi is stopped, the fleet waits up to 60 s");
  expect_part(gdb.err(), "`break YourPlanner::plan`), then `continue`");
  end(fleet);
}

TEST_F(Attach, AUserWhoInspectsAProgramDoesNotChangeTheFlight) {
  SKEIN_NEEDS_GDB();
  // On a busy machine, gdb needs more time to read symbols than the default timeout of an agent.
  const Arguments flight = {scenario_, "--planner",   "patrol",          "--duration",
                            "400",     "--no-oracle", "--agent-timeout", "600"};
  SkeinRun& fleet = start("fleet", flight);
  ASSERT_TRUE(fleet.wait_until_flying()) << fleet.err();
  ChildProcess& gdb = typed("gdb", {"skein", "attach", "changi", "--run", fleet.dir()},
                            "break skein::agent::PatrolPlanner::plan\ncontinue\nprint in.tick\ndelete\ndetach\nquit\n");
  EXPECT_EQ(gdb.wait().code, 0) << gdb.out() << gdb.err();
  expect_part(gdb.out(), "$1 = ");
  EXPECT_EQ(fleet.exit_code(), 0) << fleet.err();
  EXPECT_EQ(fleet.digest(), run("plain", joined(flight, {"--one-process"})).digest());
}

// Both fleets use the same domains, in separate network namespaces that no other test uses.
TEST_F(Attach, AFleetInAnotherNetworkIsNotTakenForTheOneHere) {
  if (std::system("unshare --net true 2>/dev/null") != 0) GTEST_SKIP() << "no network namespaces here: not root";
  const auto start_apart = [&](const std::string& name) -> ChildProcess& {
    return start_program(
        name, {"/usr/bin/env", "unshare", "--net", "/bin/sh", "-c", "ip link set lo up && exec \"$0\" \"$@\"",
               program("skein"), "run", scenario_, "--planner", "patrol", "--duration", "600", "--no-oracle",
               "--domain", "40", "--out", dir(name)});
  };
  ChildProcess &here = start_apart("here"), &there = start_apart("there");
  ASSERT_TRUE(eventually([&] { return is_flying(dir("here")) && is_flying(dir("there")); }))
      << here.err() << there.err();
  const auto typed_here = [&](const Arguments& words) {
    const std::string network = "--net=/proc/" + std::to_string(here.pid()) + "/ns/net";
    ChildProcess& typed = start_program("typed", joined({"/usr/bin/nsenter", network, program("skein")}, words));
    EXPECT_EQ(typed.wait().code, 0) << typed.err();
    return typed.out();
  };
  const std::string text = typed_here({"ps"});
  const std::string launcher = "launcher " + std::to_string(here.pid());
  const std::size_t first = text.find(launcher);
  ASSERT_NE(first, std::string::npos) << text;
  EXPECT_EQ(text.find(launcher, first + 1), std::string::npos) << text;
  expect_part(text, ", in another network namespace\n");
  EXPECT_EQ(std::stoi(typed_here({"attach", "changi=echo"})), processes_of(dir("here")).at("uav_agent-changi"))
      << "the one here, without a question";
  EXPECT_EQ(std::stoi(typed_here({"attach", "changi=echo", "--run", dir("there")})),
            processes_of(dir("there")).at("uav_agent-changi"));
  for (ChildProcess* const fleet : {&here, &there}) {
    fleet->signal(SIGINT);
    EXPECT_EQ(fleet->wait().code, 130) << fleet->err();
  }
}

TEST_F(Attach, AnUnknownProgramIsRefused) {
  EXPECT_EQ(skein({"attach", "changi", "--run", folder()}).wait().code, 2);
  SkeinRun& fleet = flying_fleet();
  ChildProcess& wrong = skein({"attach", "chang", "--run", fleet.dir()});
  EXPECT_EQ(wrong.wait().code, 2);
  expect_part(wrong.err(), "changi");
  end(fleet);
}

}  // namespace
}  // namespace skein::test
