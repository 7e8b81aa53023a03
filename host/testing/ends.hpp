// For tests of processes that end others: waits for ends, with a limit. If a mistake lets a process live on, the test
// fails soon and does not hang.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "host/proc_table.hpp"
#include "tests/support/eventually.hpp"

namespace skein::cli {

/// Longer than a process takes to notice the end of another one, and shorter than kPatience: several tests in turn may
/// wait in vain.
inline constexpr std::chrono::seconds kUntilNoticed{15};

/// Programs started while it lives inherit one end of a pipe; the other end tells when the last of them is gone.
class OpenUntilAllEnded {
 public:
  OpenUntilAllEnded() { EXPECT_EQ(::pipe2(fds_, O_NONBLOCK), 0); }
  ~OpenUntilAllEnded() { ::close(fds_[0]); }
  OpenUntilAllEnded(const OpenUntilAllEnded&) = delete;
  OpenUntilAllEnded& operator=(const OpenUntilAllEnded&) = delete;
  /// Waits for it. @returns whether it came in time.
  bool all_ended() {
    ::close(fds_[1]);
    char c;
    return eventually([&] { return ::read(fds_[0], &c, 1) == 0; }, kUntilNoticed);
  }

 private:
  int fds_[2];
};

/// Kills the children of this process, so that no test has to wait for their ends any longer.
inline void kill_own_children() {
  for (const pid_t pid : all_processes()) {
    if (parent_of(pid) == ::getpid()) ::kill(pid, SIGKILL);
  }
}

}  // namespace skein::cli
