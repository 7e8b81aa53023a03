#include "cli/standard_output.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <iostream>

namespace skein::cli {
namespace {

/// Whether lost_output() reports a loss in a process that prints `text` to this descriptor.
bool is_lost(int output, const std::string& text) {
  std::cout.flush();
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGPIPE, SIG_IGN);
    ::dup2(output, STDOUT_FILENO);
    std::cout << text;
    ::_exit(lost_output().empty() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status) != 0;
}

TEST(StandardOutput, IsReportedAsLostIfTheDiskIsFull) {
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC), null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const std::size_t length : {1, 100, 100'000}) {
    EXPECT_TRUE(is_lost(full, std::string(length, 'x'))) << length;
    EXPECT_FALSE(is_lost(null, std::string(length, 'x'))) << length;
  }
  EXPECT_FALSE(is_lost(full, "")) << "without output, nothing can be lost";
  ::close(full);
  ::close(null);
}

TEST(StandardOutput, IsNotReportedAsLostIfTheReaderOfThePipeHasGone) {
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  ::close(pipe[0]);
  EXPECT_FALSE(is_lost(pipe[1], "a reader like `head` has read enough"));
  ::close(pipe[1]);
}

}  // namespace
}  // namespace skein::cli
