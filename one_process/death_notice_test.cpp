#include "one_process/death_notice.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <latch>
#include <string>
#include <thread>

#include "process/health/crash_notes.hpp"
#include "process/status/shared_lines.hpp"
#include "tests/support/places.hpp"

namespace skein::one_process {
namespace {

/// An object that all programs of the process use. It is created on first use, and exit() destroys it.
class Shared {
 public:
  static Shared& instance() {
    static Shared shared;
    return shared;
  }
  ~Shared() {
    gone = true;
    std::latch(1).wait();  // blocks, so that the other thread can use the destroyed object
  }
  static std::atomic<bool> gone;
};
std::atomic<bool> Shared::gone = false;

/// A process in which one program calls exit() while another one flies.
[[noreturn]] void fly_until_exit(int status_fd, int code, bool from_other_thread) {
  note_crashes(std::filesystem::temp_directory_path());
  DeathNotice::watch(status_fd);
  const DeathNotice flies("flies"), leaves("leaves");
  std::latch both(2);
  const auto fly = [&] {
    flies.enter();
    both.count_down();
    while (!Shared::gone) std::this_thread::yield();
    std::raise(SIGSEGV);  // as if a program had used a destroyed object
  };
  const auto leave = [&] {
    leaves.enter();
    both.arrive_and_wait();
    Shared::instance();
    std::exit(code);
  };
  std::thread other = from_other_thread ? std::thread(leave) : std::thread(fly);
  if (from_other_thread) fly();
  leave();
  ::_exit(99);
}

TEST(DeathNotice, AProgramThatCallsExitEndsAllBeforeOthersUseDestroyedObjects) {
  if (!sanitizer().empty()) GTEST_SKIP() << "a process with threads that forks; and the end is the sanitizer's";
  for (const int code : {0, 7}) {
    for (const bool from_other_thread : {false, true}) {
      int pipe[2];
      ASSERT_EQ(::pipe(pipe), 0);
      const pid_t child = ::fork();
      if (child == 0) fly_until_exit(pipe[1], code, from_other_thread);
      ::close(pipe[1]);
      std::string text;
      char part[4096];
      for (ssize_t got = 0; (got = ::read(pipe[0], part, sizeof part)) > 0;)
        text.append(part, static_cast<std::size_t>(got));
      ::close(pipe[0]);
      int status = 0;
      ASSERT_EQ(::waitpid(child, &status, 0), child);
      EXPECT_TRUE(WIFEXITED(status)) << status;
      EXPECT_EQ(WEXITSTATUS(status), code);
      const auto news = shared_lines::read_news(text.substr(1, text.size() - 2));
      ASSERT_TRUE(news && std::holds_alternative<shared_lines::Ended>(*news)) << text;
      const auto& ended = std::get<shared_lines::Ended>(*news);
      EXPECT_EQ(ended.program, "leaves");
      EXPECT_EQ(ended.signal, 0);
      EXPECT_NE(ended.code, 0);
      EXPECT_TRUE(ended.fatal);
    }
  }
}

}  // namespace
}  // namespace skein::one_process
