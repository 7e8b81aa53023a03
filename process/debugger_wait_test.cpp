#include "process/debugger_wait.hpp"

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace skein {
namespace {

constexpr int kWentOn = 0;
constexpr int kForgotten = 1;  ///< It would have waited for ever.

/// A process that waits for a debugger.
class Waiting {
 public:
  /// Returns when it waits.
  Waiting() {
    int ready[2];
    EXPECT_EQ(::pipe(ready), 0);
    process_ = ::fork();
    if (process_ == 0) {
      constexpr int kManyLooks = 2000;
      int looks = 0;
      wait_for_debugger([&] {
        if (looks == 0 && ::write(ready[1], "r", 1) != 1) ::_exit(2);
        return ++looks > kManyLooks;
      });
      ::_exit(looks > kManyLooks ? kForgotten : kWentOn);
    }
    char letter = 0;
    EXPECT_EQ(::read(ready[0], &letter, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  pid_t process() const { return process_; }
  int end() const {
    int status = 0;
    EXPECT_EQ(::waitpid(process_, &status, 0), process_);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

 private:
  pid_t process_ = 0;
};

/// Attaches to all threads, as gdb does, and leaves again. False where the kernel does not allow it.
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

TEST(DebuggerWait, GoesOnWhenADebuggerHasComeAndGoneAtAnyInstant) {
  std::mt19937 random(std::random_device{}());
  std::uniform_int_distribution<int> microseconds(0, 120'000);
  for (int i = 0; i < 25; ++i) {
    const Waiting waiting;
    const int delay = i == 0 ? 0 : microseconds(random);
    std::this_thread::sleep_for(std::chrono::microseconds(delay));
    if (!look_at(waiting.process())) {
      ::kill(waiting.process(), SIGCONT);
      waiting.end();
      GTEST_SKIP() << "this process may not attach to another";
    }
    EXPECT_EQ(waiting.end(), kWentOn) << "attached " << delay << " us after the wait had begun";
  }
}

TEST(DebuggerWait, GoesOnAtSigcont) {
  const Waiting waiting;
  ::kill(waiting.process(), SIGCONT);
  EXPECT_EQ(waiting.end(), kWentOn);
}

TEST(DebuggerWait, EndsWhenItIsTold) {
  int looks = 0;
  wait_for_debugger([&] { return ++looks == 3; });
  EXPECT_EQ(looks, 3);
  EXPECT_FALSE(is_debugged());
}

}  // namespace
}  // namespace skein
