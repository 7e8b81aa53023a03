// A watched run, without a browser: its digest, its exit code, and its files.
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>

#include "page_client.hpp"
#include "view_fixture.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

const Arguments kShort = {"towers", "--planner", "kios", "--duration", "20", "--no-oracle", "--no-report"};

/// Inodes of all listening TCP sockets of this host.
std::set<std::string> listening_inodes() {
  std::set<std::string> inodes;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream in(table);
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::vector<std::string> cells;
      for (std::string word; words >> word;) cells.push_back(word);
      if (cells.size() > 9 && cells[3] == "0A") inodes.insert(cells[9]);
    }
  }
  return inodes;
}

/// Number of a process's listening sockets, however many descriptors they have.
std::size_t listeners_of(pid_t pid) {
  const std::set<std::string> listening = listening_inodes();
  std::set<std::string> own;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(pid) + "/fd", error)) {
    const std::string target = fs::read_symlink(entry.path(), error);
    const std::string begin = "socket:[";
    if (!target.starts_with(begin)) continue;
    const std::string inode = target.substr(begin.size(), target.size() - begin.size() - 1);
    if (listening.contains(inode)) own.insert(inode);
  }
  return own.size();
}

class WatchedRun : public ViewTest {};

TEST_F(WatchedRun, HasTheDigestOfARunThatIsNotWatched) {
  const SkeinRun& unseen = run("unseen", joined(kShort, {"--one-process"}));
  const std::string activity = text_of(unseen.dir() / "activity.csv");
  for (const std::string& uav : kFleet) EXPECT_NE(activity.find("," + uav + ",takes off,"), std::string::npos) << uav;
  EXPECT_NE(activity.find(",changi,on the ground,,,,jurong,\n"), std::string::npos)
      << "changi must report that it waits for jurong, which starts beside it: " << activity;
  const auto expect_same = [&](const std::string& name, const Arguments& how) {
    const SkeinRun& seen = run(name, joined(kShort, how));
    EXPECT_EQ(seen.digest(), unseen.digest()) << name;
    EXPECT_EQ(text_of(seen.dir() / "activity.csv"), activity) << name;
  };
  expect_same("one", {"--one-process", "--view", "--view-close", "--speed", "max"});
  expect_same("one8", {"--one-process", "--view", "--view-close", "--speed", "16"});
  expect_same("dds", {"--view", "--view-close", "--speed", "max"});
  expect_same("dds8", {"--view", "--view-close", "--dds", "fastdds"});
}

TEST_F(WatchedRun, OpensPortsOnlyAtItsStationAndForItsReplay) {
  SkeinRun& seen = start(
      "seen", joined(kShort, {"--view", "--speed", "0.5"}));  // slow, so that the run does not end before the check
  ASSERT_TRUE(seen.wait_until_flying()) << seen.err();
  for (const auto& [name, pid] : processes_of(seen.dir())) {
    EXPECT_EQ(listeners_of(pid), name == "station" || name == "skein" ? 1U : 0U) << name;
  }
  seen.skein().signal(SIGINT);
  EXPECT_EQ(seen.exit_code(), 130) << "an interrupted run must end without a replay: " << seen.err();

  SkeinRun& unseen = start("unseen", kShort);
  ASSERT_TRUE(unseen.wait_until_flying()) << unseen.err();
  for (const auto& [name, pid] : processes_of(unseen.dir())) EXPECT_EQ(listeners_of(pid), 0U) << name;
  EXPECT_EQ(unseen.exit_code(), 0);
}

TEST_F(WatchedRun, EndsWithItsOwnExitCodeWhenItsReplayEnds) {
  SkeinRun& seen = start("seen", joined(kShort, {"--view", "--speed", "2"}));
  ASSERT_TRUE(seen.wait_until_flying()) << seen.err();
  ::kill(processes_of(seen.dir()).at("uav_agent-changi"), SIGKILL);
  ASSERT_TRUE(seen.wait_for("replay")) << seen.err();
  EXPECT_TRUE(fs::exists(seen.dir() / "result.json")) << "results must exist before the user leaves the page";
  EXPECT_TRUE(fs::exists(door_of(seen)));
  EXPECT_EQ(seen.skein().ended(), std::nullopt);
  seen.skein().signal(SIGINT);
  EXPECT_EQ(seen.exit_code(), 3);
  EXPECT_FALSE(fs::exists(door_in(seen.err()).parent_path())) << "the folder with the key was not deleted";
}

// A slow machine lengthens the total time, and makes the run's own time no longer than the rest without the pause.
TEST_F(WatchedRun, PausedTimeDoesNotCountAsTimeOfTheRun) {
  const auto now = [&](const std::string& moment) { return fs::last_write_time(write(moment, moment)); };
  const auto begin = now("begin");
  SkeinRun& seen = start(
      "seen", joined(kShort, {"--one-process", "--stop-at", "0.5", "--view", "--view-close", "--pause-at", "0.2"}));
  PageClient page(door_of(seen));
  ASSERT_TRUE(page.wait([&] { return page.state().is_object() && page.state()["paused"] == true; })) << seen.err();
  const auto paused = now("paused");
  eventually([] { return false; }, std::chrono::seconds(5));
  const auto resumed = now("resumed");
  page.ask({{"do", "resume"}});
  page.wait([] { return false; });
  ASSERT_EQ(seen.exit_code(), 0) << seen.err();
  const std::chrono::duration<double> without_pause = now("end") - begin - (resumed - paused);
  EXPECT_LT(seen.result()["wall_time_s"].get<double>(), without_pause.count());
}

TEST_F(WatchedRun, RefusesInvalidOptionsAndAPortInUse) {
  run("clock", joined(kShort, {"--view", "--speed", "2", "--clock", "realtime"}), {}, 2);
  run("speed", joined(kShort, {"--view", "--speed", "0.01"}), {}, 2);
  run("unwatched", joined(kShort, {"--speed", "2"}), {}, 2);
  run("unpaused", joined(kShort, {"--pause-at", "2"}), {}, 2);
  run("before", joined(kShort, {"--view", "--pause-at", "-1"}), {}, 2);
  run("port", joined(kShort, {"--view", "70000"}), {}, 2);
  SkeinRun& seen = start("seen", joined(kShort, {"--view"}));
  ASSERT_TRUE(seen.wait_for("127.0.0.1:")) << seen.err();
  const std::string said = seen.err();
  const std::size_t at = said.find("127.0.0.1:") + 10;
  const std::string port = said.substr(at, said.find('/', at) - at);
  SkeinRun& second = run("second", joined(kShort, {"--view", port}), {}, 2);
  EXPECT_NE(second.err().find("choose another port"), std::string::npos) << second.err();
  seen.skein().signal(SIGINT);
  EXPECT_EQ(seen.exit_code(), 130);
  ChildProcess& none = skein({"replay", folder().string()});
  EXPECT_EQ(none.wait().code, 2) << none.err();
}

}  // namespace
}  // namespace skein::test
