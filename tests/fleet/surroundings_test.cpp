// Other fleets and the user's environment do not affect a run.
#include <signal.h>

#include <random>

#include "by_hand_fixture.hpp"
#include "small_scene.hpp"
#include "tests/free_domain.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class Surroundings : public FleetTest {
 protected:
  Surroundings() : scenario_(write_small_scene(folder())) {}

  /// Starts a fleet that waits for one of its agents, with its own temporary folder.
  SkeinRun& waiting_fleet(const std::string& name, const Arguments& more = {}) {
    fs::create_directories(folder() / (name + ".tmp"));
    Arguments arguments = {scenario_, "--planner", "hover", "--debug", "changi"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(name, arguments, {{"TMPDIR", folder() / (name + ".tmp")}});
  }

  std::string scenario_;
};

TEST_F(Surroundings, FleetsWithDifferentTemporaryFoldersTakeDifferentDomains) {
  SkeinRun& a = waiting_fleet("a");
  ASSERT_TRUE(a.wait_for("gdb --args")) << a.err();
  SkeinRun& b = waiting_fleet("b");
  ASSERT_TRUE(b.wait_for("gdb --args")) << b.err();
  const auto [first_a, last_a] = a.domains();
  const auto [first_b, last_b] = b.domains();
  EXPECT_TRUE(last_a < first_b || last_b < first_a)
      << first_a << ".." << last_a << " and " << first_b << ".." << last_b;

  SkeinRun& c = waiting_fleet("c", {"--domain", std::to_string(last_a)});
  EXPECT_EQ(c.exit_code(), 2);
  EXPECT_NE(
      c.err().find("uses domain " + std::to_string(last_a) + " (process " + std::to_string(a.skein().pid()) + ")"),
      std::string::npos)
      << c.err();
  for (SkeinRun* run : {&a, &b}) {
    run->skein().signal(SIGINT);
    EXPECT_EQ(run->exit_code(), 130) << run->err();
  }
}

TEST_F(Surroundings, AProgramThatIsStartedByHandHasTheEnvironmentOfAFleetsProgram) {
  const FreeDomains domains(4);
  ChildProcess& station = start_program(
      "station",
      {program("station"), "--scenario", scenario_, "--domain", std::to_string(domains.base()), "--out", folder()},
      {{"LC_ALL", "de_DE.UTF-8"}, {"CYCLONEDDS_URI", "nonsense"}});
  const fs::path environment = "/proc/" + std::to_string(station.pid()) + "/environ";
  const auto has = [&](const std::string& entry) {
    const std::string text = '\0' + text_of(environment);
    return text.find('\0' + entry) != std::string::npos;
  };
  EXPECT_TRUE(eventually([&] { return has("LC_ALL=C") || station.ended(); })) << station.err();
  EXPECT_TRUE(has("GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2")) << text_of(environment);
  EXPECT_FALSE(has("CYCLONEDDS_URI"));
  station.signal(SIGTERM);
  station.wait();
}

// With a low hard limit of open files, the DDS vendor ended a server or router that no launcher had started.
TEST_F(Surroundings, AProgramThatIsStartedByHandReportsATooLowLimitOfOpenFiles) {
  const FreeDomains domains(4);
  for (const std::string name : {"sim_server", "comm_router"}) {
    for (const std::string vendor : {"cyclonedds", "fastdds"}) {
      ChildProcess& refused =
          start_program(name + "-" + vendor,
                        {"/bin/sh", "-c", "ulimit -n 40; exec \"$@\"", "sh", program(name), "--scenario", scenario_,
                         "--domain", std::to_string(domains.base()), "--dds", vendor, "--out", folder()});
      EXPECT_EQ(refused.wait().code, 2) << refused.err();
      const std::string message =
          name + ": a process may have 40 open files (ulimit -n), and this program, which joins 4";
      EXPECT_NE(refused.err().find(message), std::string::npos) << refused.err();
    }
  }
}

/// Variables that once prevented a fleet from starting, or could change it; HERE is a folder with the files.
const std::vector<std::pair<std::string, std::string>> kHostileVariables = {
    {"ROS_DISCOVERY_SERVER", "127.0.0.1:11811"},
    {"ROS_SUPER_CLIENT", "TRUE"},
    {"ROS_DOMAIN_ID", "17"},
    {"ROS_LOCALHOST_ONLY", "1"},
    {"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"},
    {"FASTRTPS_DEFAULT_PROFILES_FILE", "HERE/DEFAULT_FASTRTPS_PROFILES.xml"},
    {"FASTDDS_ENVIRONMENT_FILE", "HERE/environment.json"},
    {"CYCLONEDDS_URI",
     "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='none0'/></Interfaces></General>"
     "</Domain></CycloneDDS>"},
    {"RMW_FASTRTPS_USE_QOS_FROM_XML", "1"},
    {"LC_ALL", "de_DE.UTF-8"},
    {"LC_NUMERIC", "de_DE.UTF-8"},
    {"TZ", "Pacific/Chatham"},
    {"HOME", "/nowhere"},
    {"OMP_NUM_THREADS", "64"},
    {"SKEIN_SECURITY", "/nowhere"},
    {"SKEIN_DOMAIN", "3"},
    {"SKEIN_CHOAS", "3"}};
/// Commands that a shell may execute before it starts the launcher.
const std::vector<std::string> kHostileShells = {"umask 0777",
                                                 "umask 0",
                                                 "exec 0<&-",
                                                 "exec 1>&- 0<&-",
                                                 "trap '' CHLD",
                                                 "trap '' PIPE",
                                                 "exec 7</dev/null 9>/dev/null",
                                                 "ulimit -c 0",
                                                 "trap '' HUP INT",
                                                 "ulimit -n 256",
                                                 "cd \"$HERE\""};

class HostileSurroundings : public Surroundings, public testing::WithParamInterface<unsigned> {};

TEST_P(HostileSurroundings, DoNotChangeTheFlight) {
  std::mt19937 random(GetParam());
  const auto chosen = [&] { return random() % 2 == 0; };
  const fs::path here = folder() / "here";
  // A default profile with which each participant would look for a discovery server that does not exist.
  write("here/DEFAULT_FASTRTPS_PROFILES.xml", R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"><profiles>
  <participant profile_name="hostile" is_default_profile="true"><rtps>
    <builtin><discovery_config><discoveryProtocol>CLIENT</discoveryProtocol></discovery_config></builtin>
    <useBuiltinTransports>false</useBuiltinTransports>
  </rtps></participant>
</profiles></dds>)");
  write("here/environment.json", R"({"environment_variables": {"ROS_DISCOVERY_SERVER": "127.0.0.1:11812"}})");
  Environment environment = {{"HERE", here}};
  std::string drawn;
  for (auto [name, value] : kHostileVariables) {
    if (!chosen()) continue;
    if (value.starts_with("HERE")) value.replace(0, 4, here);
    environment[name] = value;
    drawn += name + " ";
  }
  std::string shell;
  for (const std::string& line : kHostileShells) {
    if (chosen()) shell += line + "; ";
  }
  SCOPED_TRACE(drawn + "; " + shell);
  const std::string vendor = std::vector<std::string>{"fastdds", "cyclonedds", "mixed"}[GetParam() % 3];
  const Arguments flight = {scenario_, "--planner", "patrol", "--duration", "5", "--dds", vendor};
  const std::string digest = run("plain", flight).digest();

  const fs::path out = folder() / "out";
  Arguments argv = {"/bin/sh", "-c", shell + "exec \"$@\"", "sh", program("skein"), "run"};
  argv.insert(argv.end(), flight.begin(), flight.end());
  argv.insert(argv.end(), {"--out", out});
  ChildProcess& skein = start_program("hostile", argv, environment);
  ASSERT_EQ(skein.wait().code, 0) << skein.err();
  const Json result = Json::parse(text_of(out / "result.json"));
  EXPECT_EQ(result["digest"], digest);
  for (const char* name :
       {"ROS_DISCOVERY_SERVER", "FASTDDS_ENVIRONMENT_FILE", "CYCLONEDDS_URI", "SKEIN_DOMAIN", "SKEIN_CHOAS"}) {
    if (!environment.contains(name)) continue;
    EXPECT_NE(skein.err().find(name), std::string::npos)
        << "the launcher does not say that it ignores " << name << ": " << skein.err();
    EXPECT_NE(result["warnings"].dump().find(name), std::string::npos) << result["warnings"];
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, HostileSurroundings, testing::Range(0u, 4u));

class ByHandSurroundings : public ByHand {};

// The client in place of changi communicates only with programs that have the same run number.
TEST_F(ByHandSurroundings, AllProgramsTakeTheNumberOfTheRun) {
  const Options options{.all = {"--duration", "3"}, .server = {"--agent-timeout", "10"}};
  for (const std::string& name : kPrograms) {
    Environment environment = {{"SKEIN_RUN", "7"}};
    if (member(name) == "changi") {
      environment["SKEIN_DOMAIN"] = std::to_string(uav_domain(domains_.base(), index(name)));
      environment["SKEIN_UAV"] = "changi";
      environment["SKEIN_DDS"] = "cyclonedds";
    }
    const bool client = environment.contains("SKEIN_UAV");
    fleet_[name] = &start_program(name, client ? Arguments{helper_program("minimal_client")} : command(name, options),
                                  environment);
  }
  for (const auto& [name, process] : fleet_) EXPECT_EQ(process->wait().code, 0) << name << ": " << process->err();
  const Json report = server_report();
  EXPECT_EQ(report["flight"]["run"], 7);
  EXPECT_EQ(report["status"], "completed");
  EXPECT_TRUE(report["lost_members"].empty()) << report["lost_members"];
}

}  // namespace
}  // namespace skein::test
