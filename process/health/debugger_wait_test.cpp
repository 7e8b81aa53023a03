#include "process/health/debugger_wait.hpp"

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace skein {
namespace {

constexpr int kWentOn = 0;
constexpr int kForgotten = 1;  ///< the process would have waited for ever
constexpr int kLooksTold = 3;

/// A process that waits for a debugger.
class Waiting {
 public:
  /// Starts the process, and returns when it waits.
  Waiting() {
    int looked[2];
    EXPECT_EQ(::pipe(looked), 0);
    process_ = ::fork();
    if (process_ == 0) {
      constexpr int kManyLooks = 2000;
      int looks = 0;
      wait_for_debugger([&] {
        if (looks < kLooksTold && ::write(looked[1], "l", 1) != 1) ::_exit(2);
        return ++looks > kManyLooks;
      });
      ::_exit(looks > kManyLooks ? kForgotten : kWentOn);
    }
    ::close(looked[1]);
    looks_ = looked[0];
    see_a_look();
  }
  ~Waiting() { ::close(looks_); }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

  /// Returns when the process has looked for a debugger once more. Works kLooksTold times in all.
  void see_a_look() const {
    char letter = 0;
    EXPECT_EQ(::read(looks_, &letter, 1), 1);
  }
  pid_t process() const { return process_; }
  int end() const {
    int status = 0;
    EXPECT_EQ(::waitpid(process_, &status, 0), process_);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

 private:
  pid_t process_ = 0;
  int looks_ = -1;
};

/// Attaches to all threads of a process, as gdb does, and detaches. @returns false if the kernel does not allow it.
bool look_at(pid_t process) {
  std::vector<pid_t> threads;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    const pid_t thread = std::stoi(entry.path().filename());
    if (::ptrace(PTRACE_ATTACH, thread, nullptr, nullptr) != 0) break;
    EXPECT_EQ(::waitpid(thread, nullptr, __WALL), thread);
    threads.push_back(thread);
  }
  for (const pid_t thread : threads) EXPECT_EQ(::ptrace(PTRACE_DETACH, thread, nullptr, nullptr), 0);
  return !threads.empty();
}

TEST(DebuggerWait, EndsWhenADebuggerHasAttachedAndDetachedAtAnyInstant) {
  std::mt19937 random(std::random_device{}());
  std::uniform_int_distribution<int> looks(0, 2), calls(0, 100'000);  // some milliseconds of system calls
  for (int i = 0; i < 25; ++i) {
    const Waiting waiting;
    const int looked = i == 0 ? 0 : looks(random), called = i == 0 ? 0 : calls(random);
    for (int look = 0; look < looked; ++look) waiting.see_a_look();
    for (int n = 0; n < called; ++n) ::getppid();
    if (!look_at(waiting.process())) {
      ::kill(waiting.process(), SIGCONT);
      waiting.end();
      GTEST_SKIP() << "this process may not attach to another";
    }
    EXPECT_EQ(waiting.end(), kWentOn) << "attached after " << looked << " looks and " << called << " calls";
  }
}

TEST(DebuggerWait, EndsAtSigcont) {
  const Waiting waiting;
  ::kill(waiting.process(), SIGCONT);
  EXPECT_EQ(waiting.end(), kWentOn);
}

TEST(DebuggerWait, EndsWhenTheCallerSaysSo) {
  int looks = 0;
  wait_for_debugger([&] { return ++looks == 3; });
  EXPECT_EQ(looks, 3);
  EXPECT_FALSE(is_debugged());
}

}  // namespace
}  // namespace skein
