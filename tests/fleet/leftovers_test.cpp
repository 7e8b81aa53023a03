// All processes that a user's command has started end with the run, even those in the background, in a session of their
// own, or with an empty environment. They also end if the launcher is killed.
#include <signal.h>

#include <sstream>

#include "fleet_fixture.hpp"
#include "small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

class Leftovers : public FleetTest {
 protected:
  Leftovers() : scenario_(write_small_scene(folder())) {
    script_ = write("g.sh",
                    "\"$1\" & client=$!\n"
                    "sleep 1000 & echo $! > \"$2\"\n"
                    "setsid sleep 1000 & echo $! >> \"$2\"\n"
                    "env -i setsid sleep 1000 & echo $! >> \"$2\"\n"
                    "echo $client >> \"$2\"\n"
                    "wait $client\n");
  }

  SkeinRun& start_run(const std::string& duration) {
    const std::string command =
        "/bin/sh " + script_.string() + " " + helper_program("minimal_client") + " " + (folder() / "pids").string();
    return start("run", {scenario_, "--duration", duration, "--planner", "hover,jurong=exec:" + command});
  }

  /// The four processes that the command has started.
  std::vector<pid_t> started() const {
    std::istringstream in(text_of(folder() / "pids"));
    std::vector<pid_t> pids;
    for (pid_t pid = 0; in >> pid;) pids.push_back(pid);
    EXPECT_EQ(pids.size(), 4u);
    return pids;
  }

  void expect_gone(const std::vector<pid_t>& pids) const {
    for (const pid_t pid : pids) {
      const auto gone = [&] {
        const std::string status = text_of("/proc/" + std::to_string(pid) + "/status");
        return status.empty() || status.find("\nState:\tZ") != std::string::npos;
      };
      EXPECT_TRUE(eventually(gone, std::chrono::seconds(20))) << pid << " is still there";
      if (!gone()) ::kill(pid, SIGKILL);
    }
  }

  std::string scenario_;
  std::filesystem::path script_;
};

TEST_F(Leftovers, EndWithTheProgram) {
  SkeinRun& run = start_run("5");
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  EXPECT_TRUE(run.result()["deterministic"]);
  expect_gone(started());
}

TEST_F(Leftovers, EndWhenTheLauncherIsKilled) {
  SkeinRun& run = start_run("2000");
  ASSERT_TRUE(run.wait_until_flying()) << run.err();
  run.skein().signal(SIGKILL);
  EXPECT_EQ(run.skein().wait().signal, SIGKILL);
  expect_gone(started());
  EXPECT_TRUE(eventually([&] { return processes_of(run.dir()).empty(); }, std::chrono::seconds(20)));
}

TEST_F(Leftovers, EndWhenTheProgramIsKilled) {
  SkeinRun& run = start_run("2000");
  ASSERT_TRUE(run.wait_until_flying()) << run.err();
  const std::vector<pid_t> pids = started();
  ASSERT_FALSE(pids.empty());
  ::kill(pids.back(), SIGKILL);  // the client; then its shell ends
  ASSERT_TRUE(run.wait_for("uav_agent-jurong failed: exit code 137")) << run.err();
  expect_gone(pids);
  run.skein().signal(SIGINT);
  EXPECT_EQ(run.exit_code(), 130) << run.err();
}

}  // namespace
}  // namespace skein::test
