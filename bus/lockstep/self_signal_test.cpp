#include "bus/lockstep/self_signal.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>

namespace skein::bus {
namespace {

constexpr int kNotPermitted = 77;

/// Runs `body` in a process of its own, in a new PID namespace where it is the first, or as any other.
/// @returns its status, as wait() tells it. @param meanwhile  runs in its parent, with its number.
int run_as(bool first, const std::function<void()>& body, const std::function<void(pid_t)>& meanwhile = {}) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    if (first && ::unshare(CLONE_NEWPID) != 0) ::_exit(kNotPermitted);
    const pid_t child = ::fork();
    if (child == 0) {
      body();
      ::_exit(0);
    }
    if (meanwhile) meanwhile(child);
    int status = 0;
    ::waitpid(child, &status, 0);
    ::_exit(WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status));
  }
  int status = 0;
  ::waitpid(parent, &status, 0);
  return WEXITSTATUS(status);
}

char state_of(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(in, text);
  const std::size_t name_end = text.rfind(')');
  return name_end == std::string::npos ? '?' : text[name_end + 2];
}

bool catches_continue(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("SigCgt:")) return ((std::stoull(line.substr(7), nullptr, 16) >> (SIGCONT - 1)) & 1U) != 0;
  }
  return true;  // it has ended
}

class SelfSignal : public testing::TestWithParam<bool> {};

TEST_P(SelfSignal, AKilledProgramIsDead) {
  const int status = run_as(GetParam(), [] { kill_ourselves(); });
  if (status == kNotPermitted) GTEST_SKIP() << "a PID namespace takes root";
  EXPECT_EQ(status, 128 + SIGKILL);
}

TEST_P(SelfSignal, AStoppedProgramDoesNothingUntilItIsContinued) {
  void* const memory =
      ::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto& phase = *new (memory) std::atomic<int>(0);
  const auto body = [&] {
    phase = 1;
    stop_ourselves();
    ::_exit(phase == 2 ? 0 : 1);  // continued by whom we expect
  };
  const auto meanwhile = [&](pid_t child) {
    // It sleeps or stands still; what returned at once would have ended.
    const char asleep = GetParam() ? 'S' : 'T';
    while (phase == 0 || (GetParam() && !catches_continue(child))) ::sched_yield();
    for (char state = '?'; state != asleep && state != 'Z'; state = state_of(child)) ::sched_yield();
    phase = 2;
    ::kill(child, SIGCONT);
  };
  const int status = run_as(GetParam(), body, meanwhile);
  ::munmap(memory, sizeof(std::atomic<int>));
  if (status == kNotPermitted) GTEST_SKIP() << "a PID namespace takes root";
  EXPECT_EQ(status, 0);
}

INSTANTIATE_TEST_SUITE_P(OfAnyPlace, SelfSignal, testing::Values(false, true), [](const auto& place) {
  return place.param ? std::string("FirstOfItsNamespace") : std::string("AnyOther");
});

}  // namespace
}  // namespace skein::bus
