// Programs without a launcher (--keep): they detect lost programs, come back when a fault ends, and end properly on
// request.
#include <signal.h>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "by_hand_fixture.hpp"

namespace skein::test {
namespace {

/// Duration of a fault [s]: so long that a program that restarts at once must wait until the server lets it back in.
constexpr double kAway_s = 5.0;

class Unattended : public ByHand, public testing::WithParamInterface<std::string> {
 protected:
  /// Options without timeouts: a dead program that is not detected would stop the run for ever.
  Options kept(Arguments more = {}, const std::string& duration_s = "60", const std::string& lease_s = "3") const {
    more.insert(more.end(), {"--duration", duration_s, "--keep", "--dds", GetParam(), "--lease", lease_s});
    return {.all = std::move(more), .server = {"--agent-timeout", "0", "--startup-timeout", "0"}};
  }
  /// The process id of the program below its keeper.
  pid_t worker(const std::string& name) const {
    const std::string pid = std::to_string(fleet_.at(name)->pid());
    std::istringstream children(text_of("/proc/" + pid + "/task/" + pid + "/children"));
    pid_t child = 0;
    children >> child;
    return child;
  }
  void expect_good_ends() {
    for (const auto& [name, process] : fleet_) EXPECT_EQ(process->wait().code, 0) << name << ": " << process->err();
  }
  std::string said(const std::string& name) { return fleet_.at(name)->err(); }

  std::mt19937 random_{std::random_device{}()};
};

// Every program is killed once and paused once, in a random order.
TEST_P(Unattended, FaultsHaveTheSameEffectAsUnderTheLauncher) {
  std::vector<std::string> victims = {"changi", "jurong", "sentosa", "station", "comm_router"}, stopped = victims;
  std::ranges::shuffle(victims, random_);
  std::ranges::shuffle(stopped, random_);
  std::string faults = "faults:\n";
  for (std::size_t i = 0; i < victims.size(); ++i) {
    const double at_s = 12.0 + 15.0 * static_cast<double>(i);
    faults += fmt::format("  - {{at_s: {}, until_s: {}, kill: {}}}\n", at_s, at_s + kAway_s, victims[i]);
    faults += fmt::format("  - {{at_s: {}, until_s: {}, pause: {}}}\n", at_s + 7.0, at_s + 7.0 + kAway_s, stopped[i]);
  }
  SCOPED_TRACE(faults);
  const std::string file = write("faults.yaml", faults);
  SkeinRun& launched =
      run("launched", {"towers", "--planner", "patrol", "--duration", "90", "--dds", GetParam(), "--faults", file});
  start_fleet(kept({"--faults", file}, "90"));
  expect_good_ends();
  const Json report = server_report();
  EXPECT_EQ(report["status"], "completed") << report;
  EXPECT_TRUE(report["lost_members"].empty()) << report["lost_members"];
  EXPECT_EQ(report["digest"], launched.digest());
  for (const std::string& victim : victims) {
    const std::string program = fleet_.contains(victim) ? victim : "uav_agent-" + victim;
    EXPECT_NE(said(program).find("here it starts again"), std::string::npos) << program << ": " << said(program);
    EXPECT_NE(said(program).find("joins again when the fault ends"), std::string::npos)
        << program << ": " << said(program);
  }
  const Json station = Json::parse(text_of(dir_ / "station.report.json"));
  EXPECT_EQ(station["score"], launched.result()["score"]);
}

TEST_P(Unattended, AProgramThatIsKilledIsLostAndWorksAgain) {
  start_fleet(kept());
  ASSERT_TRUE(eventually([&] { return is_flying(dir_); }));
  std::vector<std::string> victims = {"uav_agent-changi", "station", "comm_router"};
  std::ranges::shuffle(victims, random_);
  for (const std::string& victim : victims) {
    ::kill(worker(victim), SIGKILL);
    const std::string back = member(victim) + " joined again";
    EXPECT_TRUE(eventually([&] { return said("sim_server").find(back) != std::string::npos; }))
        << victim << ": " << said("sim_server");
  }
  expect_good_ends();
  const Json report = server_report();
  EXPECT_EQ(report["status"], "completed");
  ASSERT_EQ(report["lost_members"].size(), victims.size()) << report["lost_members"];
  for (const Json& lost : report["lost_members"]) {
    EXPECT_EQ(lost["reason"], "it has left, or gives no sign of life");
    EXPECT_GE(lost["back_at_s"].get<double>(), lost["time_s"].get<double>());
  }
  EXPECT_GT(Json::parse(text_of(dir_ / "station.report.json"))["score"], 0.0);
}

TEST_P(Unattended, AProgramThatIsAskedToEndLeavesAndTheRunGoesOn) {
  start_fleet(kept());
  ASSERT_TRUE(eventually([&] { return is_flying(dir_); }));
  const std::string uav = kPrograms.at(std::uniform_int_distribution<std::size_t>(3, kPrograms.size() - 1)(random_));
  fleet_.at(uav)->signal(SIGTERM);
  EXPECT_EQ(fleet_.at(uav)->wait().code, 0) << said(uav);
  expect_run_without(uav, "it has left");
  EXPECT_TRUE(std::filesystem::exists(dir_ / (uav + ".report.json")));
}

TEST_P(Unattended, AServerThatIsAskedToEndEndsTheRunInGoodOrder) {
  start_fleet(kept());
  ASSERT_TRUE(eventually([&] { return is_flying(dir_); }));
  fleet_.at("sim_server")->signal(SIGTERM);
  expect_good_ends();
  EXPECT_EQ(server_report()["status"], "interrupted");
  EXPECT_TRUE(server_report()["lost_members"].empty()) << server_report()["lost_members"];
  for (const std::string& name : kPrograms) {
    EXPECT_TRUE(std::filesystem::exists(dir_ / (name + ".report.json"))) << name;
  }
}

TEST_P(Unattended, AllProgramsEndWhenTheyAreAskedAtOnce) {
  start_fleet(kept());
  ASSERT_TRUE(eventually([&] { return is_flying(dir_); }));
  std::vector<std::string> order = kPrograms;
  std::ranges::shuffle(order, random_);
  for (const std::string& name : order) fleet_.at(name)->signal(SIGTERM);
  expect_good_ends();
  EXPECT_EQ(server_report()["status"], "interrupted");
}

// This includes a program that is still restarting when the server ends.
TEST_P(Unattended, AProgramThatIsKilledForGoodEndsWithTheRun) {
  std::vector<std::string> victims = {"changi", "station", "comm_router"};
  std::string faults = "faults:\n";
  for (const std::string& victim : victims) {
    faults += fmt::format("  - {{at_s: {}, kill: {}}}\n", std::uniform_real_distribution(5.0, 20.0)(random_), victim);
  }
  SCOPED_TRACE(faults);
  Options options = kept({"--faults", write("faults.yaml", faults)});
  options.server.insert(options.server.end(), {"--stop-at", "20"});
  start_fleet(options);
  expect_good_ends();
  EXPECT_EQ(server_report()["status"], "completed");
  EXPECT_TRUE(server_report()["lost_members"].empty()) << server_report()["lost_members"];
  EXPECT_FALSE(std::filesystem::exists(dir_ / "uav_agent-changi.report.json"))
      << "the restarted program never joined, so it must not write a report";
}

// A run must not use the journal and the reports of the other run.
TEST_P(Unattended, TwoRunsInOneFolderDoNotUseEachOthersFiles) {
  const auto brief = [&](const std::string& run) {
    Options options = kept({"--run", run});
    options.server.insert(options.server.end(), {"--stop-at", "20"});
    return options;
  };
  start_fleet(brief("5"));
  expect_good_ends();
  const std::string digest = server_report()["digest"];
  const Json station = Json::parse(text_of(dir_ / "station.report.json"));
  start_fleet(brief("6"));
  expect_good_ends();
  EXPECT_EQ(server_report()["digest"], digest);
  EXPECT_EQ(server_report()["flight"]["run"], 6);
  EXPECT_EQ(Json::parse(text_of(dir_ / "station.report.json"))["score"], station["score"]);

  ChildProcess& again = start_program("again", command("sim_server", brief("6")));
  EXPECT_EQ(again.wait().code, 2);
  EXPECT_NE(again.err().find("with the same number (6)"), std::string::npos) << again.err();
  EXPECT_EQ(server_report()["digest"], digest) << "the refused server has changed the report";
}

// The health check of a container looks at the same file.
TEST_P(Unattended, AProgramThatHangsNoLongerTouchesItsFile) {
  namespace fs = std::filesystem;
  const std::string hangs = "uav_agent-jurong", works = "uav_agent-changi";
  const Options options = kept({}, "600", "60");  // timeouts that do not drop a paused program
  std::map<std::string, Arguments> with_health;
  for (const std::string& name : {hangs, works}) {
    with_health[name] = command(name, options);
    with_health[name].insert(with_health[name].end(), {"--health", folder() / name});
  }
  start_fleet(options, with_health);
  ASSERT_TRUE(eventually([&] { return is_flying(dir_); }));
  const auto touched = [&](const std::string& name) { return fs::last_write_time(folder() / name); };
  const pid_t hung = worker(hangs);
  ::kill(hung, SIGSTOP);
  ASSERT_TRUE(
      eventually([&] { return text_of(fmt::format("/proc/{}/stat", hung)).find(") T ") != std::string::npos; }));
  const auto last = touched(hangs);
  for (int beat = 0; beat < 2; ++beat) {
    const auto before = touched(works);
    EXPECT_TRUE(eventually([&] { return touched(works) > before; }));
    EXPECT_EQ(touched(hangs), last);
  }
  ::kill(hung, SIGCONT);
  EXPECT_TRUE(eventually([&] { return touched(hangs) > last; }));
  for (const auto& [name, process] : fleet_) process->signal(SIGTERM);
  expect_good_ends();
}

INSTANTIATE_TEST_SUITE_P(Vendors, Unattended, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

}  // namespace
}  // namespace skein::test
