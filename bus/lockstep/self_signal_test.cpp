#include "bus/lockstep/self_signal.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <string>

namespace skein::bus {
namespace {

constexpr int kNotPermitted = 77;

/// Runs `body` in a new process: as the first process of a new PID namespace if `first`, else as an ordinary process.
/// @returns its exit code, or 128 + its signal.
int run_as(bool first, const std::function<void()>& body) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    if (first && ::unshare(CLONE_NEWPID) != 0) ::_exit(kNotPermitted);
    const pid_t child = ::fork();
    if (child == 0) {
      body();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ::_exit(WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status));
  }
  int status = 0;
  ::waitpid(parent, &status, 0);
  return WEXITSTATUS(status);
}

class SelfSignal : public testing::TestWithParam<bool> {};

TEST_P(SelfSignal, AKilledProgramIsDead) {
  const int status = run_as(GetParam(), [] { kill_ourselves(); });
  if (status == kNotPermitted) GTEST_SKIP() << "only root may create a PID namespace";
  EXPECT_EQ(status, 128 + SIGKILL);
}

TEST_P(SelfSignal, AProgramThatCannotBeContinuedIsNotStopped) {
  const int status = run_as(GetParam(), [] {
    bool asked = false;
    set_self_signals({.kill = {}, .stop = [&] { asked = true; }});
    stop_ourselves();
    ::_exit(asked ? 42 : 1);
  });
  if (status == kNotPermitted) GTEST_SKIP() << "only root may create a PID namespace";
  EXPECT_EQ(status, 42);
}

INSTANTIATE_TEST_SUITE_P(OfAnyPlace, SelfSignal, testing::Values(false, true), [](const auto& place) {
  return place.param ? std::string("FirstOfItsNamespace") : std::string("AnyOther");
});

TEST(SelfSignalOfAProgram, AStoppedProgramStandsStillUntilItIsContinued) {
  const pid_t child = ::fork();
  if (child == 0) {
    stop_ourselves();
    ::_exit(42);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, WUNTRACED), child);
  EXPECT_TRUE(WIFSTOPPED(status));
  ::kill(child, SIGCONT);
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 42);
}

TEST(SelfSignalOfAProgram, AUsersOwnCommandDoesNotStopItself) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv("SKEIN_UAV", "jurong", 1);
    stop_ourselves();
    ::_exit(42);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, WUNTRACED), child);
  if (WIFSTOPPED(status)) {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  EXPECT_TRUE(WIFEXITED(status)) << "it stopped itself; if the launcher has continued it before, it stands for ever";
  EXPECT_EQ(WEXITSTATUS(status), 42);
}

}  // namespace
}  // namespace skein::bus
