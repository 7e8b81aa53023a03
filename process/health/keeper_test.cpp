#include "process/health/keeper.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <memory>
#include <string>

#include "tests/support/eventually.hpp"

namespace skein {
namespace {

constexpr int kNotPermitted = 77;

/// Memory that all processes of a test share.
struct Shared {
  std::atomic<int> lives{0};
  std::atomic<pid_t> worker{0};
  std::atomic<bool> ready{false};  ///< the program waits for a signal
};

/// The parameter: whether the keeper is the first process of a PID namespace, as in a container.
class Keeper : public testing::TestWithParam<bool> {
 protected:
  Keeper() {
    void* const memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    shared_ = new (memory) Shared;
  }
  ~Keeper() override { ::munmap(shared_, sizeof(Shared)); }

  /// Starts a keeper whose program is `work`. It gets the number of its life, from 1, and returns an exit code.
  /// @param meanwhile  called with the keeper's process id. @returns the keeper's exit code, or 200 + its signal.
  int keep(const std::function<int(int)>& work, const std::function<void(pid_t)>& meanwhile = {}) {
    const pid_t parent = ::fork();
    if (parent == 0) {
      if (GetParam() && ::unshare(CLONE_NEWPID) != 0) ::_exit(kNotPermitted);
      const pid_t keeper = ::fork();
      if (keeper == 0) {
        int lives = 0;
        if (const auto code = keep_alive(lives)) ::_exit(*code);
        shared_->worker = ::getpid();
        shared_->lives = lives;
        ::_exit(work(lives));
      }
      if (meanwhile) meanwhile(keeper);
      int status = 0;
      ::waitpid(keeper, &status, 0);
      ::_exit(WIFSIGNALED(status) ? 200 + WTERMSIG(status) : WEXITSTATUS(status));
    }
    int status = 0;
    ::waitpid(parent, &status, 0);
    return WEXITSTATUS(status);
  }
  /// Sends a signal to the keeper. Its program calls `then` with the signal that it gets.
  int keep_and_send(int signal, const std::function<int(int)>& then) {
    shared_->lives = 0;
    const auto work = [&](int) {
      sigset_t awaited;
      ::sigemptyset(&awaited);
      ::sigaddset(&awaited, signal);
      ::sigprocmask(SIG_BLOCK, &awaited, nullptr);
      shared_->ready = true;
      int got = 0;
      ::sigwait(&awaited, &got);
      return then(got);
    };
    const int status = keep(work, [&](pid_t keeper) {
      while (!shared_->ready) ::sched_yield();
      ::kill(keeper, signal);
    });
    shared_->ready = false;
    return status;
  }

  Shared* shared_;
};

#define SKIP_WITHOUT_RIGHTS(status) \
  if ((status) == kNotPermitted) GTEST_SKIP() << "only root can create a PID namespace"

TEST_P(Keeper, RestartsAKilledProgramAndReturnsItsExitCode) {
  for (const int code : {0, 2, 3}) {
    shared_->lives = 0;
    const int status = keep([&](int life) {
      if (life < 4) std::raise(SIGKILL);
      return code;
    });
    SKIP_WITHOUT_RIGHTS(status);
    EXPECT_EQ(status, code);
    EXPECT_EQ(shared_->lives, 4);
  }
}

TEST_P(Keeper, ACrashedProgramIsNotRestarted) {
  const int status = keep([](int) {
    std::signal(SIGSEGV, SIG_DFL);
    return std::raise(SIGSEGV);
  });
  SKIP_WITHOUT_RIGHTS(status);
  EXPECT_EQ(status, 128 + SIGSEGV);
  EXPECT_EQ(shared_->lives, 1);
}

TEST_P(Keeper, ARequestToEndReachesTheProgram) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    const int status = keep_and_send(signal, [](int got) { return got; });
    SKIP_WITHOUT_RIGHTS(status);
    EXPECT_EQ(status, signal);
  }
}

TEST_P(Keeper, AProgramThatWasAskedToEndIsNotRestarted) {
  const int status = keep_and_send(SIGTERM, [](int) { return std::raise(SIGKILL); });
  SKIP_WITHOUT_RIGHTS(status);
  EXPECT_EQ(status, 128 + SIGKILL);
  EXPECT_EQ(shared_->lives, 1);
}

TEST_P(Keeper, KillingTheKeeperKillsTheProgram) {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // makes the program a child of this process when the keeper is dead
  const int status = keep(
      [&](int) {
        shared_->ready = true;
        ::alarm(30);
        while (true) ::pause();
        return 0;
      },
      [&](pid_t keeper) {
        while (!shared_->ready) ::sched_yield();
        ::kill(keeper, SIGKILL);
      });
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
  SKIP_WITHOUT_RIGHTS(status);
  EXPECT_EQ(status, 200 + SIGKILL);
  if (GetParam()) return;  // the kernel ends the namespace with its first process
  EXPECT_TRUE(eventually([&] { return ::waitpid(shared_->worker, nullptr, WNOHANG) == shared_->worker; }));
}

INSTANTIATE_TEST_SUITE_P(OfAnyPlace, Keeper, testing::Values(false, true), [](const auto& place) {
  return place.param ? std::string("FirstOfItsNamespace") : std::string("AnyOther");
});

}  // namespace
}  // namespace skein
