// `skein run --place`: a fleet over hosts on which the launcher logs in by ssh.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "fleet_fixture.hpp"
#include "login_hosts.hpp"
#include "small_scene.hpp"
#include "tests/free_domain.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

class Place : public FleetTest {
 protected:
  void SetUp() override {
    std::filesystem::permissions(folder(), std::filesystem::perms(0755));  // secured agents read the scenario
    if (const std::string why = login_.set_up(folder()); !why.empty()) GTEST_SKIP() << why;
  }
  void TearDown() override {
    for (const char* host : {"b", "c"}) {
      EXPECT_TRUE(login_.is_clean(host)) << host << ": " << testing::PrintToString(login_.processes_on(host))
                                         << testing::PrintToString(login_.files_on(host));
    }
    FleetTest::TearDown();
  }

  Arguments words(const std::string& name, const Arguments& more, const std::string& planner) const {
    return login_.hosts().on("a", joined({program("skein"), "run", scene_, "--planner", planner, "--no-oracle",
                                          "--no-report", "--out", folder() / name, "--ssh", login_.ssh()},
                                         more));
  }
  ChildProcess& fly(const std::string& name, const Arguments& more, const std::string& planner = "patrol") {
    return start_program(name, words(name, more, planner));
  }
  Json result(const std::string& name) const {
    return Json::parse(text_of(folder() / name / "result.json"), nullptr, false);
  }
  bool wait_until_flying(const std::string& name, ChildProcess& launcher) {
    eventually([&] { return is_flying(folder() / name) || launcher.ended(); });
    return !launcher.ended();
  }

  /// A script that runs `skein` on a host by a command. @param name  of its folder
  std::string write_skein(const std::string& name, const std::string& command) const {
    const auto file = write(name + "/skein", "#!/bin/sh\n" + command + " " + program("skein") + " \"$@\"\n");
    std::filesystem::permissions(file, std::filesystem::perms(0755));
    std::filesystem::permissions(file.parent_path(), std::filesystem::perms(0755));
    return file;
  }
  /// A script that runs `skein` on a host as an ordinary user, whichever user logs in.
  std::string write_unprivileged_skein() const {
    return write_skein("nobody", "exec setpriv --reuid=nobody --regid=nogroup --clear-groups");
  }

  LoginHosts login_{{"a", "b", "c"}};
  const std::string scene_ = write_small_scene(folder());
};

const Arguments kBoth = {"--place", "jurong=b,changi=c"};

class PlaceByVendor : public Place, public testing::WithParamInterface<Arguments> {};

// Faults kill one agent and pause another; processes on their hosts carry this out.
TEST_P(PlaceByVendor, FliesTheSameAsOnOneHost) {
  const Arguments flight =
      joined({"--duration", "25", "--keep-maps", "--faults",
              write("faults.yaml",
                    "faults:\n  - {at_s: 3, until_s: 6, kill: jurong}\n  - {at_s: 4, until_s: 7, pause: changi}\n")},
             GetParam());
  run("one", joined({scene_, "--planner", "patrol", "--no-oracle", "--no-report"}, flight));
  ChildProcess& launcher = fly("two", joined(kBoth, flight));
  std::vector<std::string> seen;
  eventually([&] {
    const auto files = login_.files_on("b");
    seen.insert(seen.end(), files.begin(), files.end());
    return launcher.ended().has_value();
  });
  EXPECT_EQ(launcher.wait().code, 0) << launcher.err();
  const Json one = result("one"), two = result("two");
  ASSERT_TRUE(one.is_object() && two.is_object()) << launcher.err();
  EXPECT_EQ(two["digest"], one["digest"]);
  EXPECT_FALSE(two["digest"].is_null());
  EXPECT_EQ(two["lost_members"], one["lost_members"]);
  for (const char* file : {"recording.mcap", "score.csv", "map-jurong.bt", "map-changi.bt", "maps-jurong.mcap"}) {
    EXPECT_TRUE(text_of(folder() / "two" / file) == text_of(folder() / "one" / file)) << file;
  }
  for (const char* file : {"uav_agent-jurong.log", "uav_agent-changi.report.json"}) {
    EXPECT_FALSE(text_of(folder() / "two" / file).empty()) << file;
  }
  // The agent's host had the files that an agent may read, and no others of the scene.
  const auto had = [&](const std::string& name) {
    return std::ranges::any_of(seen, [&](const std::string& file) { return file.ends_with(name); });
  };
  EXPECT_TRUE(had("/scenario.yaml")) << testing::PrintToString(seen);
  for (const char* secret : {"points.pcd", "mesh.stl"}) EXPECT_FALSE(had(secret)) << secret;
}

INSTANTIATE_TEST_SUITE_P(Vendors, PlaceByVendor,
                         testing::Values(Arguments{"--dds", "cyclonedds"}, Arguments{"--dds", "fastdds"},
                                         Arguments{"--secure"}, Arguments{"--secure", "--dds", "fastdds"}),
                         [](const auto& tested) { return "v" + std::to_string(tested.index); });

TEST_F(Place, AFleetLosesTheUavsOfAHostThatVanishes) {
  ChildProcess& launcher = fly("run", joined(kBoth, {"--duration", "120"}));
  ASSERT_TRUE(wait_until_flying("run", launcher)) << launcher.err();
  login_.cut("b");
  // On a host without connection, the minder ends all programs.
  EXPECT_TRUE(login_.is_clean("b")) << testing::PrintToString(login_.processes_on("b"));
  EXPECT_EQ(launcher.wait().code, 3);
  EXPECT_NE(launcher.err().find("uav_agent-jurong failed: its host b is gone"), std::string::npos) << launcher.err();
  const Json flown = result("run");
  ASSERT_EQ(flown["lost_members"].size(), 1U) << flown["lost_members"];
  EXPECT_EQ(flown["lost_members"][0]["member"], "jurong");
  EXPECT_EQ(flown["status"], "completed") << "the other UAVs did not fly on";
  login_.mend("b");
}

/// The clocks of the three hosts show different times of day.
class PlaceByOtherClocks : public Place {
 protected:
  void SetUp() override {
    if (!login_.set_time_of_day("b", "+5h") || !login_.set_time_of_day("c", "-30d")) {
      GTEST_SKIP() << "no libfaketime here (apt-get install libfaketime)";
    }
    Place::SetUp();
    if (IsSkipped()) return;
    ASSERT_TRUE(
        login_.hosts().run("a", "sh -c 'test $(" + login_.ssh() + " b date +%s) -gt $(( $(date +%s) + 14400 ))'"));
    ASSERT_TRUE(
        login_.hosts().run("a", "sh -c 'test $(" + login_.ssh() + " c date +%s) -lt $(( $(date +%s) - 14400 ))'"));
  }
};

TEST_F(PlaceByOtherClocks, FliesTheSameAsOnOneHost) {
  const std::string faults =
      "faults:\n  - {at_s: 3, until_s: 6, kill: jurong}\n  - {at_s: 4, until_s: 7, pause: changi}\n";
  for (const char* vendor : {"cyclonedds", "fastdds"}) {
    const Arguments flight = {"--duration", "15", "--dds", vendor, "--faults", write("faults.yaml", faults)};
    const std::string one = std::string("one ") + vendor, two = std::string("two ") + vendor;
    run(one, joined({scene_, "--planner", "patrol", "--no-oracle", "--no-report"}, flight));
    ChildProcess& launcher = fly(two, joined(kBoth, flight));
    EXPECT_EQ(launcher.wait().code, 0) << launcher.err();
    EXPECT_FALSE(result(two)["digest"].is_null()) << launcher.err();
    EXPECT_EQ(result(two)["digest"], result(one)["digest"]);
    EXPECT_EQ(result(two)["lost_members"], result(one)["lost_members"]);
    EXPECT_TRUE(text_of(folder() / two / "recording.mcap") == text_of(folder() / one / "recording.mcap"));
  }
}

/// Minders, leases and the timeout of a hanging agent work with different clocks.
TEST_F(PlaceByOtherClocks, LossesAreNoticedDespiteTheClocks) {
  ChildProcess& launcher =
      fly("run", joined(kBoth, {"--duration", "20", "--agent-timeout", "3"}), "patrol,changi=exec:exec sleep 1000");
  EXPECT_EQ(launcher.wait().code, 3) << launcher.err();
  ASSERT_EQ(result("run")["lost_members"].size(), 1U) << result("run")["lost_members"];
  EXPECT_EQ(result("run")["lost_members"][0]["member"], "changi");
  ChildProcess& cut = fly("cut", joined(kBoth, {"--duration", "120"}));
  ASSERT_TRUE(wait_until_flying("cut", cut)) << cut.err();
  login_.cut("b");
  EXPECT_TRUE(login_.is_clean("b")) << testing::PrintToString(login_.processes_on("b"));
  EXPECT_EQ(cut.wait().code, 3);
  EXPECT_NE(cut.err().find("uav_agent-jurong failed: its host b is gone"), std::string::npos) << cut.err();
  EXPECT_EQ(result("cut")["lost_members"].size(), 1U) << result("cut")["lost_members"];
  EXPECT_EQ(result("cut")["status"], "completed") << "the other UAVs did not fly on";
  login_.mend("b");
}

TEST_F(Place, AKilledLauncherLeavesNothingOnAnyHost) {
  ChildProcess& launcher = fly("run", joined(kBoth, {"--duration", "2000"}));
  ASSERT_TRUE(wait_until_flying("run", launcher)) << launcher.err();
  EXPECT_FALSE(login_.processes_on("b").empty());
  EXPECT_FALSE(login_.processes_on("c").empty());
  launcher.signal(SIGKILL);
  launcher.wait();
  EXPECT_TRUE(login_.is_clean("b")) << testing::PrintToString(login_.processes_on("b"));
  EXPECT_TRUE(login_.is_clean("c")) << testing::PrintToString(login_.processes_on("c"));
  EXPECT_TRUE(eventually([&] { return processes_of(folder() / "run").empty(); }));
}

TEST_F(Place, AUsersCommandAndItsChildrenEndWithTheRun) {
  // The command leaves a child in another session.
  ChildProcess& launcher =
      fly("run", {"--place", "jurong=b", "--duration", "10", "--agent-timeout", "10"},
          "patrol,jurong=exec:setsid sleep 1000 & env > \"$SKEIN_OUT/env\"; sleep 1; kill -SEGV $$");
  EXPECT_EQ(launcher.wait().code, 3) << launcher.err();
  EXPECT_NE(launcher.err().find("uav_agent-jurong failed: signal 11"), std::string::npos) << launcher.err();
  const std::string variables = text_of(folder() / "run/uav_agent-jurong.env");
  EXPECT_NE(variables.find("SKEIN_UAV=jurong\n"), std::string::npos) << variables;
  EXPECT_NE(variables.find("SKEIN_NETWORK={'jurong': {peers: "), std::string::npos) << variables;
}

TEST_F(Place, ASecuredAgentHasItsOwnUserIdOnAnotherHost) {
  ChildProcess& launcher = fly("run", {"--place", "jurong=b", "--secure", "--duration", "8", "--agent-timeout", "10"},
                               "patrol,jurong=exec:(id -u; head -n 1 \"$SKEIN_SECURITY/key.pem\") > \"$SKEIN_OUT/id\"");
  launcher.wait();
  const std::string said = text_of(folder() / "run/uav_agent-jurong.id");
  const int uid = std::atoi(said.c_str());
  EXPECT_GE(uid, 60706) << said << launcher.err();
  EXPECT_LE(uid, 61182) << said;
  EXPECT_NE(said.find("PRIVATE KEY"), std::string::npos) << said;
}

TEST_F(Place, ANetworkFaultIsNamedBeforeTheFlight) {
  const FreeDomains domains(4);
  const int port = 7400 + 250 * (domains.base() + 2);
  if (!login_.hosts().run("b", "iptables -A INPUT -p udp --dport " + std::to_string(port) + ":" +
                                   std::to_string(port + 249) + " -j DROP")) {
    ASSERT_TRUE(login_.hosts().run("b", "ip link set eth0 mtu 1300"));
  }
  ChildProcess& launcher =
      fly("run", {"--place", "jurong=b", "--duration", "5", "--domain", std::to_string(domains.base())});
  EXPECT_EQ(launcher.wait().code, 2) << launcher.err();
  EXPECT_NE(launcher.err().find("the hosts do not hear each other"), std::string::npos) << launcher.err();
  EXPECT_TRUE(launcher.err().find("MTU") != std::string::npos || launcher.err().find("UDP ports") != std::string::npos)
      << launcher.err();
  EXPECT_FALSE(std::filesystem::exists(folder() / "run/sim_server.log"));
}

TEST_F(Place, DomainsThatAnotherHostUsesAreNotTaken) {
  ChildProcess& first = start_program(
      "first", login_.hosts().on("b", {program("skein"), "run", scene_, "--planner", "hover", "--duration", "2000",
                                       "--no-oracle", "--no-report", "--out", folder() / "first"}));
  ASSERT_TRUE(wait_until_flying("first", first)) << first.err();
  ChildProcess& second = fly("second", {"--place", "jurong=b", "--duration", "5"});
  EXPECT_EQ(second.wait().code, 0) << second.err();
  EXPECT_NE(first.err().find("DDS domains 1..4"), std::string::npos) << first.err();
  EXPECT_NE(second.err().find("DDS domains 5..8"), std::string::npos) << second.err();
  ChildProcess& third = fly("third", {"--place", "jurong=b", "--duration", "5", "--domain", "3"});
  EXPECT_EQ(third.wait().code, 2);
  EXPECT_NE(third.err().find("on b: --domain 3"), std::string::npos) << third.err();
  first.signal(SIGINT);
  first.wait();
}

// Executes the printed commands on each host.
TEST_F(Place, AFleetThatIsStartedByHandFliesTheSame) {
  const Arguments flight = {"--duration", "10", "--dds", "fastdds"};
  run("one", joined({scene_, "--planner", "patrol", "--no-oracle", "--no-report"}, flight));
  std::array<char, 256> own{};
  ::gethostname(own.data(), own.size() - 1);
  for (const char* host : {"a", "b"}) {
    login_.hosts().tell(host, own.data(), login_.hosts().address(0, "a"));
    login_.hosts().tell(host, "b", login_.hosts().address(0, "b"));
  }
  ChildProcess& printed = fly("hand", joined({"--place", "jurong=b", "--print"}, flight));
  ASSERT_EQ(printed.wait().code, 0) << printed.err();
  const std::string text = printed.out();
  const std::size_t there = text.find("# on b"), after = text.find("# when the run is over");
  ASSERT_TRUE(there != std::string::npos && after != std::string::npos) << text;
  ChildProcess& b =
      start_program("hand-b", login_.hosts().on("b", {"/bin/sh", "-c", text.substr(there, after - there)}));
  ChildProcess& a = start_program("hand-a", login_.hosts().on("a", {"/bin/sh", "-c", text.substr(0, there)}));
  a.wait();
  b.wait();
  EXPECT_EQ(skein({"merge", folder() / "hand"}).wait().code, 0) << text << a.err() << b.err();
  EXPECT_EQ(result("hand")["digest"], result("one")["digest"]) << text << a.err() << b.err();
}

// If the login is not root's, agents run as that user, and the launcher reports this.
TEST_F(Place, ASecuredAgentWithoutItsOwnUserIdIsNamed) {
  ChildProcess& launcher = start_program(
      "run", login_.hosts().on("a", {program("skein"), "run", scene_, "--planner", "patrol", "--duration", "8",
                                     "--secure", "--no-oracle", "--no-report", "--out", folder() / "run", "--place",
                                     "jurong=b", "--ssh", login_.ssh(), "--skein-path", write_unprivileged_skein()}));
  EXPECT_EQ(launcher.wait().code, 0) << launcher.err();
  const std::string warning =
      "--secure on b: the launcher does not log in as root there, so uav_agent-jurong runs as the user nobody";
  EXPECT_NE(launcher.err().find(warning), std::string::npos) << launcher.err();
  EXPECT_NE(result("run")["warnings"].dump().find(warning), std::string::npos);
}

// The launcher's check of the limit is about its own host.
TEST_F(Place, AHostOnWhichTooFewFilesMayBeOpenIsNamedWithTheLimit) {
  const Arguments flight = {"--place", "jurong=b", "--duration", "5", "--no-check", "--skein-path"};
  ChildProcess& refused = fly("refused", joined(flight, {write_skein("hard", "ulimit -n 22\nexec")}));
  EXPECT_EQ(refused.wait().code, 3) << refused.err();
  EXPECT_NE(refused.err().find("uav_agent-jurong failed: "), std::string::npos) << refused.err();
  EXPECT_NE(refused.err().find("a process may have 22 open files (ulimit -n), and this program, which joins 1 DDS "
                               "domain, needs about 29"),
            std::string::npos)
      << refused.err();
  ChildProcess& raised = fly("raised", joined(flight, {write_skein("soft", "ulimit -S -n 12\nexec")}));
  EXPECT_EQ(raised.wait().code, 0) << raised.err();
}

TEST_F(Place, WrongInputEndsWithExitCodeTwoAndStartsNothing) {
  const std::filesystem::path other =
      write("other/skein", "#!/bin/sh\nexec env SKEIN_BIN_DIR=" + (folder() / "other").string() + " " +
                               program("skein") + " \"$@\"\n");
  std::filesystem::permissions(other, std::filesystem::perms::owner_all);
  write("other/uav_agent", "another build");
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"--place", "jurnog=b"}, "there is no UAV 'jurnog'; did you mean 'jurong'?"},
      {{"--place", "jurong"}, "must be UAV=HOST"},
      {{"--place", "jurong=-oProxyCommand=x"}, "is not a host"},
      {{"--place", "jurong=b,jurong=c"}, "jurong is placed twice"},
      {{"--place", "jurong=b,changi=" + login_.hosts().address(0, "b")}, "are one machine"},
      {{"--place", "jurong=" + login_.hosts().address(0, 77)}, "No route to host"},
      {{"--place", "jurong=b", "--skein-path", "/nowhere/skein"}, "No such file"},
      {{"--place", "jurong=b", "--skein-path", other}, "b has another build of Skein"},
      {{"--place", "sim_server=b"}, "stays with the launcher"},
      {{"--place", "gcs=b"}, "no program runs at the ground station"},
      {{"--place", "slurm"}, "not an allocation of Slurm"},
      {{"--place", "jurong=b", "--one-process"}, "--place needs processes"},
      {{"--place", "jurong=b", "--debug", "jurong=wait"}, "--debug and --place"}};
  for (const auto& [arguments, message] : cases) {
    ChildProcess& launcher = fly("wrong", arguments);
    EXPECT_EQ(launcher.wait().code, 2) << message;
    EXPECT_NE(launcher.err().find(message), std::string::npos) << message << '\n' << launcher.err();
    EXPECT_FALSE(std::filesystem::exists(folder() / "wrong/sim_server.log")) << message;
  }
}

}  // namespace
}  // namespace skein::test
