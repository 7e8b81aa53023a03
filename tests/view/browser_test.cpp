// The page of a run in a browser: while it flies, and when it is over. The scripts beside this look.
#include <csignal>

#include "view_fixture.hpp"

namespace skein::test {
namespace {

class PageOfARun : public ViewTest {
 protected:
  void SetUp() override {
    ViewTest::SetUp();
    if (IsSkipped()) return;
    for (const char* name : {"node", "chromium"}) {
      if (command_file(name).empty()) GTEST_SKIP() << "there is no " << name;
    }
    if (!std::filesystem::exists(source_path("web/node_modules/puppeteer-core"))) {
      GTEST_SKIP() << "web/ is not built: ./skein test does that, or `npm ci && npm run build` there";
    }
  }

  /// What a script finds wrong with a page.
  void look(const std::string& script, const std::filesystem::path& door, const std::filesystem::path& run) {
    ChildProcess& node = start_program(script, {command_file("node"), source_path("tests/view/" + script + ".mjs"),
                                                source_path("web"), command_file("chromium"), door, run});
    EXPECT_EQ(node.wait().code, 0) << node.err() << node.out();
    EXPECT_EQ(node.out(), "");
  }

  /// A flight that somebody watches, holds and lets go is the one that nobody watched.
  void watch(const Arguments& flight, const Arguments& how) {
    const std::string unseen = run("unseen", joined(flight, {"--one-process"})).digest();
    SkeinRun& seen = start("seen", joined(joined(flight, how), {"--view", "--speed", "1"}));
    const std::filesystem::path door = door_of(seen);
    look("watch", door, seen.dir());
    seen.skein().signal(SIGINT);
    EXPECT_EQ(seen.exit_code(), 0) << seen.err();
    expect_complete_result(seen);
    EXPECT_EQ(seen.digest(), unseen);
    EXPECT_FALSE(std::filesystem::exists(door)) << "the key stays";
  }
};

const Arguments kFlight = {"towers", "--planner", "kios", "--duration", "60", "--no-oracle"};

TEST_F(PageOfARun, FollowsAFleetOverDds) { watch(kFlight, {}); }

TEST_F(PageOfARun, FollowsAFleetInOneProcess) { watch(kFlight, {"--one-process"}); }

TEST_F(PageOfARun, ComesBackWithAStationThatWasKilled) {
  const auto faults = write("faults.yaml", "faults:\n  - {at_s: 16, until_s: 18, kill: station}\n");
  for (const Arguments& how : {Arguments{"--one-process"}, Arguments{}}) {
    const std::string name = how.empty() ? "dds" : "one";
    SkeinRun& seen = start(name, joined(joined(kFlight, how), {"--faults", faults, "--view", "--speed", "0.5"}));
    look("reconnect", door_of(seen), seen.dir());
    seen.skein().signal(SIGINT);
    EXPECT_EQ(seen.exit_code(), 0) << seen.err();
  }
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
