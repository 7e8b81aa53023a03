#include "host/preflight.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <random>

#include "host/testing/fake_programs.hpp"
#include "process/host/environment.hpp"
#include "tests/support/eventually.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// While an object of this class lives, scratch folders are made in a temporary folder of its own.
class OwnTmpdir {
 public:
  OwnTmpdir() {
    const char* before = std::getenv("TMPDIR");
    if (before != nullptr) before_ = before;
    ::setenv("TMPDIR", outer_.path().c_str(), 1);
  }
  ~OwnTmpdir() { before_ ? ::setenv("TMPDIR", before_->c_str(), 1) : ::unsetenv("TMPDIR"); }
  const fs::path& path() const { return outer_.path(); }
  std::ptrdiff_t entries() const { return std::distance(fs::directory_iterator(path()), {}); }

 private:
  ScratchDir outer_;
  std::optional<std::string> before_;
};

/// A process that makes scratch folders until it is killed.
pid_t start_maker() {
  const pid_t maker = ::fork();
  if (maker == 0) ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  while (maker == 0) {
    const ScratchDir scratch;
    write_text(scratch.path() / "key", "secret");
  }
  return maker;
}

TEST(ScratchDir, TheNextProcessRemovesTheFolderOfAKilledOne) {
  const OwnTmpdir tmpdir;
  std::mt19937 draw(7);
  for (int round = 0; round < 8; ++round) {
    const pid_t maker = start_maker();
    // Kill the maker at a random point of its work: after this process has seen scratch folders so many times.
    for (int looks = 1 + static_cast<int>(draw() % 15); looks > 0;) looks -= tmpdir.entries() > 0;
    ::kill(maker, SIGKILL);
    ASSERT_EQ(::waitpid(maker, nullptr, 0), maker);
    EXPECT_LE(tmpdir.entries(), 1);
    { const ScratchDir next; }
    EXPECT_EQ(tmpdir.entries(), 0) << "round " << round;
  }
}

TEST(ScratchDir, FoldersInUseAndFilesOfOthersStay) {
  const OwnTmpdir tmpdir;
  const ScratchDir mine;
  write_text(mine.path() / "key", "x");
  fs::create_directory(tmpdir.path() / "skein-notes");
  write_text(tmpdir.path() / "skein-scratch-file", "x");
  fs::create_directory(tmpdir.path() / "elsewhere");
  write_text(tmpdir.path() / "elsewhere" / "kept", "x");
  fs::create_directory_symlink(tmpdir.path() / "elsewhere", tmpdir.path() / "skein-scratch-link");
  std::vector<pid_t> makers;
  for (int i = 0; i < 3; ++i) makers.push_back(start_maker());
  for (int i = 0; i < 200; ++i) {
    const ScratchDir other;
    write_text(other.path() / "key", "y");
    EXPECT_EQ(read_text(other.path() / "key"), "y");
  }
  for (const pid_t maker : makers) {
    EXPECT_EQ(::kill(maker, SIGKILL), 0) << "the maker has ended by itself";
    int status = 0;
    ::waitpid(maker, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << status;
  }
  EXPECT_EQ(read_text(mine.path() / "key"), "x");
  EXPECT_TRUE(fs::exists(tmpdir.path() / "skein-notes") && fs::exists(tmpdir.path() / "skein-scratch-file"));
  EXPECT_TRUE(fs::exists(tmpdir.path() / "elsewhere" / "kept"));
}

TEST(RunWithin, AProgramThatDoesNotEndIsKilled) {
  const auto shell = [](const std::string& script) {
    return ProgramSpec{"a", {"/bin/sh", "-c", script}, environment_with({}), {}};
  };
  EXPECT_EQ(run_within(shell("exit 3"), kPatience).value_or(ExitStatus{}).code, 3);
  EXPECT_FALSE(run_within(shell("trap '' TERM; while :; do sleep 1000; done"), std::chrono::milliseconds(100)));
}

}  // namespace
}  // namespace skein::cli
