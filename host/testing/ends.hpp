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

/// Longer than a process takes to notice the end of another one, and shorter than kPatience, because several tests may
/// wait in vain one after the other.
inline constexpr std::chrono::seconds kUntilNoticed{15};

/// Programs that are started while this object lives inherit one end of a pipe. The other end tells when the last of
/// them has ended.
class OpenUntilAllEnded {
 public:
  OpenUntilAllEnded() { EXPECT_EQ(::pipe2(fds_, O_NONBLOCK), 0); }
  ~OpenUntilAllEnded() { ::close(fds_[0]); }
  OpenUntilAllEnded(const OpenUntilAllEnded&) = delete;
  OpenUntilAllEnded& operator=(const OpenUntilAllEnded&) = delete;
  /// Waits for the end of all these programs. @returns whether they ended in time.
  bool all_ended() {
    ::close(fds_[1]);
    char c;
    return eventually([&] { return ::read(fds_[0], &c, 1) == 0; }, kUntilNoticed);
  }

 private:
  int fds_[2];
};

/// Kills the children of this process, so that no later test waits for their ends.
inline void kill_own_children() {
  for (const pid_t pid : all_processes()) {
    if (parent_of(pid) == ::getpid()) ::kill(pid, SIGKILL);
  }
}

}  // namespace skein::cli
