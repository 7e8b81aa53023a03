// Tests a minder without a supervisor. All waits have a limit, so a faulty minder fails a test and does not hang it.
#include "host/minder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "host/proc_table.hpp"
#include "host/testing/ends.hpp"

namespace skein::cli {
namespace {

/// Fills the stack below the caller with zeros, so that no function finds values there that an earlier one left.
[[gnu::noinline]] void wipe_stack() {
  volatile char bytes[16'384];
  for (volatile char& byte : bytes) byte = 0;
}

/// Whether a process has closed all its files and sleeps, as a minder does while it waits for a signal.
bool waits(pid_t minder) {
  const std::filesystem::path folder = "/proc/" + std::to_string(minder);
  std::error_code gone;
  if (!std::filesystem::is_empty(folder / "fd", gone) || gone) return false;
  std::ifstream status(folder / "status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("State:")) return line.find('S', 6) != std::string::npos;
  }
  return false;
}

/// A minder whose program is a shell script. The script reads lines from the test and writes lines to the test.
class MinderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(::pipe2(input_, O_CLOEXEC), 0);
    ASSERT_EQ(::pipe2(output_, O_CLOEXEC | O_NONBLOCK), 0);
  }
  void TearDown() override {
    if (minder_ > 0 && !has_ended_) {
      ::kill(minder_, SIGKILL);
      ::waitpid(minder_, nullptr, 0);
    }
    for (const int fd : {input_[0], input_[1], output_[0], output_[1]}) ::close(fd);
  }

  /// Starts the minder as a child of this process, which is its launcher.
  void start(const std::string& script) {
    minder_ = fork_minder(script);
    close_output();
  }
  /// Starts the minder as a child of a launcher that does nothing. @returns the launcher
  pid_t start_below_launcher(const std::string& script) {
    int news[2];
    EXPECT_EQ(::pipe2(news, O_CLOEXEC), 0);
    const pid_t launcher = ::fork();
    if (launcher == 0) {
      const pid_t minder = fork_minder(script);
      if (::write(news[1], &minder, sizeof minder) != sizeof minder) ::_exit(1);
      for (;;) ::pause();
    }
    ::close(news[1]);
    EXPECT_EQ(::read(news[0], &minder_, sizeof minder_), static_cast<ssize_t>(sizeof minder_));
    ::close(news[0]);
    close_output();
    return launcher;
  }
  pid_t minder() const { return minder_; }
  bool minder_waits() const {
    return eventually([&] { return waits(minder_); }, kUntilNoticed);
  }

  void say(const std::string& line) const {
    EXPECT_EQ(::write(input_[1], (line + "\n").c_str(), line.size() + 1), static_cast<ssize_t>(line.size() + 1));
  }
  /// The next line that the script or a process below it writes; empty: none came in time.
  std::string heard() const {
    std::string line;
    const auto is_complete = [&] {
      for (char c = 0; ::read(output_[0], &c, 1) == 1; line += c) {
        if (c == '\n') return true;
      }
      return false;
    };
    return eventually(is_complete, kUntilNoticed) ? line : "";
  }
  /// Waits until the script has ended with all processes below it.
  bool all_ended() const {
    char c = 0;
    return eventually([&] { return ::read(output_[0], &c, 1) == 0; }, kUntilNoticed);
  }
  /// Waits until the minder stops or ends. @returns "stopped", "code 5", "signal 15", or "nothing in time".
  std::string next_change() {
    int status = 0;
    const auto has_changed = [&] { return ::waitpid(minder_, &status, WNOHANG | WUNTRACED) == minder_; };
    if (!eventually(has_changed, kUntilNoticed)) return "nothing in time";
    if (WIFSTOPPED(status)) return "stopped";
    has_ended_ = true;
    return WIFEXITED(status) ? "code " + std::to_string(WEXITSTATUS(status))
                             : "signal " + std::to_string(WTERMSIG(status));
  }
  /// Kills the launcher. Its minder must then kill all programs, and end.
  void expect_that_all_end_with(pid_t launcher) {
    EXPECT_EQ(::kill(launcher, SIGKILL), 0);
    EXPECT_EQ(::waitpid(launcher, nullptr, 0), launcher);
    EXPECT_EQ(next_change(), "code " + std::to_string(128 + SIGKILL));
    EXPECT_TRUE(all_ended());
  }

 private:
  pid_t fork_minder(const std::string& script) const {
    const pid_t launcher = ::getpid(), pid = ::fork();
    if (pid == 0) mind_script(script, launcher);
    return pid;
  }
  [[noreturn]] void mind_script(const std::string& script, pid_t launcher) const {
    wipe_stack();
    if (!become_minder(launcher)) ::_exit(99);
    const pid_t parent = ::getpid(), program = ::fork();
    if (program == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) ::_exit(127);
      sigset_t none;
      sigemptyset(&none);
      ::sigprocmask(SIG_SETMASK, &none, nullptr);
      ::dup2(input_[0], STDIN_FILENO);
      ::dup2(output_[1], STDOUT_FILENO);
      ::execl("/bin/sh", "sh", "-c", script.c_str(), nullptr);
      ::_exit(127);
    }
    wipe_stack();
    mind(program, launcher);
  }
  /// Only processes below the minder may keep the output open, so that its end tells theirs. The input stays open: a
  /// line to a script that has ended must not end the test.
  void close_output() { ::close(std::exchange(output_[1], -1)); }

  int input_[2] = {-1, -1}, output_[2] = {-1, -1};
  pid_t minder_ = -1;
  bool has_ended_ = false;
};

TEST_F(MinderTest, EndsWithTheExitCodeOfItsProgram) {
  start("read line; exit 5");
  ASSERT_TRUE(minder_waits()) << "the minder does not wait, or has kept files of its launcher open";
  EXPECT_EQ(process_name(minder()), "skein-minder");
  say("go");
  EXPECT_EQ(next_change(), "code 5");
}

TEST_F(MinderTest, EndsByTheSignalThatEndsItsProgram) {
  start("read line; kill -TERM $$");
  ASSERT_TRUE(minder_waits());
  say("go");
  EXPECT_EQ(next_change(), "signal " + std::to_string(SIGTERM));
}

TEST_F(MinderTest, NoticesAProgramThatEndsAtOnce) {
  start("exit 7");
  EXPECT_EQ(next_change(), "code 7");
}

TEST_F(MinderTest, IsNotEndedBySignals) {
  start("read line; exit 5");
  ASSERT_TRUE(minder_waits());
  EXPECT_EQ(::kill(minder(), SIGSTOP), 0);
  ASSERT_EQ(next_change(), "stopped");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGCHLD, SIGUSR1, SIGUSR2, SIGRTMIN, SIGCONT}) {
    EXPECT_EQ(::kill(minder(), signal), 0);  // all signals are pending when the minder continues
  }
  ASSERT_TRUE(minder_waits());
  say("go");
  EXPECT_EQ(next_change(), "code 5");
}

TEST_F(MinderTest, StopsWithItsProgramAndGoesOn) {
  start("echo $$; read line; kill -STOP $$; read line; exit 5");
  const pid_t program = std::atoi(heard().c_str());
  ASSERT_GT(program, 0);
  ASSERT_TRUE(minder_waits());
  say("stop");
  ASSERT_EQ(next_change(), "stopped");
  EXPECT_TRUE(has_stopped(program));
  for (const pid_t pid : {minder(), program}) EXPECT_EQ(::kill(pid, SIGCONT), 0);
  say("go");
  EXPECT_EQ(next_change(), "code 5");
}

TEST_F(MinderTest, DoesNotEndWhenAnotherProcessThanItsProgramEnds) {
  start("sh -c 'sleep 1000 & echo $!'; read line; echo alive; exit 5");
  const pid_t orphan = std::atoi(heard().c_str());
  ASSERT_GT(orphan, 0);
  ASSERT_TRUE(eventually([&] { return parent_of(orphan) == minder(); }, kUntilNoticed))
      << "the minder did not become the parent, although it is a subreaper";
  EXPECT_EQ(::kill(orphan, SIGKILL), 0);
  EXPECT_TRUE(eventually([&] { return parent_of(orphan) == 0; }, kUntilNoticed)) << "the minder has left a zombie";
  say("go");
  EXPECT_EQ(heard(), "alive");
  EXPECT_EQ(next_change(), "code 5");
}

// The minder must kill in several rounds: the children of a process become its own only when that process is dead.
TEST_F(MinderTest, KillsTheProcessesThatItsProgramLeavesBehindAlsoInTheThirdGeneration) {
  start("( (sleep 1000 & echo started; wait) & wait) & read line; exit 5");
  EXPECT_EQ(heard(), "started");
  ASSERT_TRUE(minder_waits());
  say("go");
  EXPECT_EQ(next_change(), "code 5");
  EXPECT_TRUE(all_ended());
}

TEST_F(MinderTest, KillsAllWhenTheLauncherHasDied) {
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // so that the minder becomes a child of this process
  const pid_t launcher = start_below_launcher("( (sleep 1000 & echo started; wait) & wait) & read line; exit 5");
  EXPECT_EQ(heard(), "started");
  EXPECT_TRUE(minder_waits());
  expect_that_all_end_with(launcher);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST_F(MinderTest, KillsAllWhenTheLauncherHasDiedAlsoWhileTheProgramIsStopped) {
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // so that the minder becomes a child of this process
  const pid_t launcher = start_below_launcher("echo started; kill -STOP $$; exit 5");
  EXPECT_EQ(heard(), "started");
  EXPECT_TRUE(eventually([&] { return has_stopped(minder()); }, kUntilNoticed));
  expect_that_all_end_with(launcher);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

// This process traces the minder. It kills the program after the minder has seen that the program stopped, and before
// the minder has done anything about it.
TEST_F(MinderTest, EndsIfItsProgramIsKilledWhileTheMinderIsAboutToStop) {
  start("echo $$; read line; kill -STOP $$; exit 5");
  const pid_t program = std::atoi(heard().c_str());
  ASSERT_GT(program, 0);
  ASSERT_TRUE(minder_waits());
  if (::ptrace(PTRACE_SEIZE, minder(), nullptr, PTRACE_O_TRACESYSGOOD) != 0) GTEST_SKIP() << "ptrace() is not allowed";
  EXPECT_EQ(::ptrace(PTRACE_INTERRUPT, minder(), nullptr, nullptr), 0);
  say("stop");
  bool has_seen = false;
  long call = 0;
  const auto is_about_to_stop = [&] {
    int status = 0;
    if (::waitpid(minder(), &status, WNOHANG) != minder()) return false;
    __ptrace_syscall_info info{};
    ::ptrace(PTRACE_GET_SYSCALL_INFO, minder(), sizeof info, &info);
    if (info.op == PTRACE_SYSCALL_INFO_ENTRY && has_seen) return true;
    if (info.op == PTRACE_SYSCALL_INFO_ENTRY) call = static_cast<long>(info.entry.nr);
    has_seen = info.op == PTRACE_SYSCALL_INFO_EXIT && call == SYS_wait4 && info.exit.rval == program;
    ::ptrace(PTRACE_SYSCALL, minder(), nullptr, nullptr);
    return false;
  };
  ASSERT_TRUE(eventually(is_about_to_stop, kUntilNoticed));
  for (const auto& [pid, signal] : {std::pair(program, SIGKILL), {minder(), SIGCONT}}) ::kill(pid, signal);
  EXPECT_EQ(::ptrace(PTRACE_DETACH, minder(), nullptr, nullptr), 0);
  std::string change = next_change();
  if (change == "stopped") change = next_change();  // only for a moment
  EXPECT_EQ(change, "signal " + std::to_string(SIGKILL));
}

TEST(Minder, NoticesThatTheLauncherIsAlreadyDead) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(become_minder(::getpid()) ? 1 : 0);  // its parent is another process
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

}  // namespace
}  // namespace skein::cli
