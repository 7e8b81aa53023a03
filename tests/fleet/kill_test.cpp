// Programs die, hang or are interrupted during a run: the run ends properly, reports what happened, and leaves nothing.
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <sstream>

#include "fleet_fixture.hpp"
#include "recording/mcap/reader.hpp"
#include "results/run_folder.hpp"
#include "small_scene.hpp"

namespace skein::test {
namespace {

/// A flight that is far longer than the tests let it fly, so that no test depends on the machine's speed.
const Arguments kLongRun = {"towers", "--planner", "patrol", "--duration", "2000"};
/// A flight that ends by itself, some seconds after the test has found the programs. It uses both vendors, because each
/// must cope with a sudden death.
const Arguments kShortRun = {"towers", "--planner", "patrol", "--duration", "60", "--dds", "mixed"};

class Interruption : public FleetTest {
 protected:
  /// Starts a run. @returns it when it flies with all its programs.
  SkeinRun& flying(const Arguments& arguments) {
    SkeinRun& run = start("run", arguments);
    EXPECT_TRUE(run.wait_until_flying()) << run.err();
    const auto found = processes_of(run.dir());
    for (const std::string& name : kPrograms) EXPECT_TRUE(found.contains(name)) << name;
    return run;
  }
};

class KilledProgram : public Interruption, public testing::WithParamInterface<std::string> {};

TEST_P(KilledProgram, IsNamedAndTheRunIsComplete) {
  const std::string victim = GetParam();
  const bool of_server = victim == "sim_server";
  SkeinRun& run = flying(kShortRun);
  ::kill(processes_of(run.dir()).at(victim), SIGKILL);

  EXPECT_EQ(run.exit_code(), 3) << run.err();
  EXPECT_NE(run.err().find(victim + " failed: signal 9"), std::string::npos) << run.err();
  expect_complete_result(run);
  const Json result = run.result();
  EXPECT_EQ(result["status"], of_server ? "aborted" : "completed");
  EXPECT_FALSE(result["deterministic"]);
  EXPECT_TRUE(result["digest"].is_null());
  EXPECT_FALSE(result["warnings"].empty());
  EXPECT_TRUE(std::filesystem::exists(run.dir() / "score.csv"));
  if (of_server) {
    EXPECT_GT(result["sim_time_s"], 0.0) << "the launcher must report the last time that the server reported";
    return;
  }
  EXPECT_NEAR(result["mission_time_s"].get<double>(), 60.0, 0.1) << "the other UAVs did not fly on";
  ASSERT_EQ(result["lost_members"].size(), 1u);
  const std::string member = victim.substr(victim.find('-') + 1);
  EXPECT_EQ(result["lost_members"][0]["member"], member);
  EXPECT_GT(result["lost_members"][0]["step"], 0);
  for (const Json& uav : result["uavs"]) EXPECT_EQ(uav["planner_cpu_s"].is_null(), uav["name"] == member);
}

INSTANTIATE_TEST_SUITE_P(Programs, KilledProgram,
                         testing::Values("sim_server", "comm_router", "station", "uav_agent-jurong",
                                         "uav_agent-nanyang"),
                         [](const auto& victim) {
                           std::string name = victim.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_F(Interruption, ARunThatLosesTwoProgramsIsCompleted) {
  SkeinRun& run = flying(kShortRun);
  const auto found = processes_of(run.dir());
  ::kill(found.at("comm_router"), SIGKILL);
  ::kill(found.at("uav_agent-changi"), SIGKILL);
  EXPECT_EQ(run.exit_code(), 3) << run.err();
  expect_complete_result(run);
  EXPECT_EQ(run.result()["status"], "completed");
  EXPECT_EQ(run.result()["lost_members"].size(), 2u);
}

/// The command line of a program of a fleet, without the launcher's pipes.
Arguments without_launcher(pid_t pid) {
  const std::string text = text_of("/proc/" + std::to_string(pid) + "/cmdline");
  Arguments words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, '\0');) {
    if (word == "--status-fd" || word == "--control-fd") {
      std::getline(in, word, '\0');
    } else {
      words.push_back(word);
    }
  }
  return words;
}

// As if a user has fixed a program that crashed, and starts it again.
TEST_F(Interruption, AProgramThatIsStartedAgainByHandTakesPartAgain) {
  SkeinRun& run = flying({"towers", "--planner", "patrol", "--duration", "300"});
  const pid_t pid = processes_of(run.dir()).at("uav_agent-changi");
  const Arguments words = without_launcher(pid);
  ::kill(pid, SIGKILL);
  ASSERT_TRUE(
      eventually([&] { return text_of(run.dir() / "sim_server.log").find("changi is lost") != std::string::npos; }));
  ChildProcess& again = start_program("again", words);
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  EXPECT_EQ(again.wait().code, 0) << again.err();
  EXPECT_NE(run.err().find("changi was started again by hand, and takes part again"), std::string::npos);
  const Json result = run.result();
  ASSERT_EQ(result["lost_members"].size(), 1u) << result["lost_members"];
  const Json lost = result["lost_members"][0];
  ASSERT_TRUE(lost["back_at_s"].is_number()) << lost;
  for (const Json& uav : result["uavs"]) EXPECT_FALSE(uav["program_lost"]) << uav["name"];
  int delivered = 0;
  for (const auto& row : read_csv(run.dir() / "captures.csv")) {
    const bool since =
        !row.at("delivered_at_s").empty() && std::stod(row.at("delivered_at_s")) > lost["back_at_s"].get<double>();
    delivered += row.at("uav") == "changi" && since;
  }
  EXPECT_GT(delivered, 0) << "the restarted program delivered no captures";
}

class StopSignalled : public Interruption, public testing::WithParamInterface<int> {};

TEST_P(StopSignalled, EndsTheRunWithItsResultSoFar) {
  SkeinRun& run = flying(kLongRun);
  run.skein().signal(GetParam());  // only the launcher, as with Ctrl-C at a terminal
  EXPECT_EQ(run.exit_code(), 130) << run.err();
  expect_complete_result(run);
  const Json result = run.result();
  EXPECT_EQ(result["status"], "interrupted");
  EXPECT_FALSE(result["deterministic"]);
  EXPECT_GT(result["mission_time_s"], 0.0);
  EXPECT_LT(result["mission_time_s"], 2000.0);
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
  for (const Json& uav : result["uavs"])
    EXPECT_TRUE(uav["planner_cpu_s"].is_number()) << "an agent has not written its report";
  EXPECT_EQ(read_csv(run.dir() / "score.csv").size(), result["points_total"].get<std::size_t>());
}

INSTANTIATE_TEST_SUITE_P(Signals, StopSignalled, testing::Values(SIGINT, SIGTERM), [](const auto& signal) {
  return signal.param == SIGINT ? std::string("SIGINT") : std::string("SIGTERM");
});

TEST_F(Interruption, AHungStepIsGivenUpAndOnlyTheHungAgentIsNamed) {
  SkeinRun& run = flying(kLongRun);
  ::kill(processes_of(run.dir()).at("uav_agent-sentosa"), SIGSTOP);
  run.skein().signal(SIGINT);
  EXPECT_EQ(run.exit_code(), 130) << run.err();
  expect_complete_result(run);
  const Json result = run.result();
  EXPECT_EQ(result["status"], "interrupted");
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
  EXPECT_NE(result["warnings"].dump().find("waited for sentosa"), std::string::npos) << result["warnings"];
  EXPECT_EQ(run.err().find("failed"), std::string::npos) << run.err();
  expect_nothing_left();
}

TEST_F(Interruption, BeforeTheFirstStepNoProgramIsBlamed) {
  SkeinRun& run = start("run", {"towers", "--planner", "patrol", "--debug", "changi"});
  ASSERT_TRUE(run.wait_for("gdb --args")) << run.err();
  run.skein().signal(SIGINT);
  EXPECT_EQ(run.exit_code(), 130) << run.err();
  expect_complete_result(run);
  EXPECT_EQ(run.result()["status"], "interrupted");
  EXPECT_EQ(run.err().find("failed"), std::string::npos) << run.err();
  expect_nothing_left();
}

TEST_F(Interruption, ASecondInterruptEndsTheRunAtOnce) {
  SkeinRun& run = flying(kLongRun);
  ::kill(processes_of(run.dir()).at("sim_server"), SIGSTOP);  // so that the first interrupt has no effect
  run.skein().signal(SIGINT);
  ASSERT_TRUE(run.wait_for("Ctrl-C again"));
  run.skein().signal(SIGINT);
  EXPECT_EQ(run.exit_code(), 130) << run.err();
  expect_complete_result(run);
}

TEST_F(Interruption, ProgramsDieWithTheLauncher) {
  SkeinRun& run = flying(kLongRun);
  run.skein().signal(SIGKILL);
  EXPECT_EQ(run.skein().wait().signal, SIGKILL);
  EXPECT_TRUE(eventually([&] { return processes_of(run.dir()).empty(); }, std::chrono::seconds(20)));
}

class KilledLauncher : public Interruption, public testing::WithParamInterface<std::string> {};

TEST_P(KilledLauncher, LeavesAFolderThatMergeJoins) {
  SkeinRun& run = start(
      "run", {write_small_scene(folder()), "--planner", "patrol", "--duration", "2000", "--no-oracle", GetParam()});
  ASSERT_TRUE(run.wait_until_flying()) << run.err();
  EXPECT_FALSE(processes_of(run.dir()).empty());
  run.skein().signal(SIGKILL);
  EXPECT_EQ(run.skein().wait().signal, SIGKILL);
  ASSERT_TRUE(eventually([&] { return processes_of(run.dir()).empty(); }, std::chrono::seconds(20)));
  // An agent in a container leaves its files in such a folder.
  const auto agents = run.dir() / "agents" / "jurong";
  std::filesystem::create_directories(agents);
  std::filesystem::rename(run.dir() / "uav_agent-jurong.log", agents / "uav_agent-jurong.log");

  ChildProcess& merge = skein({"merge", run.dir()});
  EXPECT_EQ(merge.wait().code, 3) << merge.err();
  EXPECT_NE(merge.err().find("missing: result.json"), std::string::npos) << merge.err();
  EXPECT_NE(merge.out().find("joined from sim_server.mcap comm_router.mcap station.mcap"), std::string::npos)
      << merge.out();
  EXPECT_TRUE(std::filesystem::exists(run.dir() / "uav_agent-jurong.log"));
  EXPECT_FALSE(std::filesystem::exists(run.dir() / "agents"));
  const auto recording = run.dir() / run_folder::kRecording;
  EXPECT_NO_THROW(mcap::Reader::whole(recording));
  std::uint64_t end_ns = 0;
  mcap::Reader(recording).messages(
      [&](const mcap::Channel&, const mcap::Message& message) { end_ns = std::max(end_ns, message.log_time); });
  EXPECT_GT(end_ns, 3'000'000'000U) << "the recording is shorter than a few seconds";
}

INSTANTIATE_TEST_SUITE_P(Media, KilledLauncher, testing::Values("--dds=mixed", "--one-process"),
                         [](const auto& medium) {
                           return std::string(medium.param == "--one-process" ? "OneProcess" : "Processes");
                         });

TEST_F(Interruption, TheNextLauncherRemovesTheFolderOfAKilledOne) {
  const std::filesystem::path tmp = folder() / "tmp";
  std::filesystem::create_directories(tmp);
  const auto left = [&] {
    const std::filesystem::directory_iterator all(tmp);
    return std::any_of(begin(all), end(all), [](const auto& entry) {
      return entry.path().filename().string().starts_with("skein-scratch-");
    });
  };
  const Arguments check = {program("skein"), "check", write_small_scene(folder())};
  std::mt19937 draw(19);
  for (int round = 0; round < 4; ++round) {
    ChildProcess& launcher = start_program("killed" + std::to_string(round), check, {{"TMPDIR", tmp}});
    auto looks = draw() % 100;  // the number of checks that see its folder before it is killed
    eventually([&] { return launcher.ended() || (left() && looks-- == 0); });
    launcher.signal(SIGKILL);
    launcher.wait();
  }
  ChildProcess& last = start_program("last", check, {{"TMPDIR", tmp}});
  EXPECT_EQ(last.wait().code, 0) << last.err();
  EXPECT_FALSE(left());
}

TEST_F(Interruption, StoppedAgentIsDroppedByTheLaunchersRun) {
  if (!long_tests()) GTEST_SKIP() << "waits for the default time-out of a minute; set SKEIN_LONG=1";
  SkeinRun& run = flying(kShortRun);
  ::kill(processes_of(run.dir()).at("uav_agent-sentosa"), SIGSTOP);
  EXPECT_EQ(run.exit_code(), 3) << run.err();
  expect_complete_result(run);
  EXPECT_EQ(run.result()["status"], "completed");
  ASSERT_EQ(run.result()["lost_members"].size(), 1u);
  EXPECT_EQ(run.result()["lost_members"][0]["member"], "sentosa");
}

}  // namespace
}  // namespace skein::test
