#include "core/files/write_whole.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <random>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

/// While it lives, files may have only so many bytes: as on a disk that becomes full.
class LimitedFiles {
 public:
  explicit LimitedFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &usual_);
    const rlimit limited{bytes, usual_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~LimitedFiles() {
    ::setrlimit(RLIMIT_FSIZE, &usual_);
    std::signal(SIGXFSZ, handler_);
  }
  LimitedFiles(const LimitedFiles&) = delete;
  LimitedFiles& operator=(const LimitedFiles&) = delete;

 private:
  rlimit usual_{};
  void (*handler_)(int);
};

TEST(WriteWhole, WritesAllOrTellsTheReason) {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.path() / "file";
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const std::size_t size = random() % 1000, room = random() % 1000;
    const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    ASSERT_GE(fd, 0);
    errno = ENOENT;  // of another call, long ago
    bool whole = false;
    int reason = 0;
    {
      const LimitedFiles limited(room);
      whole = write_whole(fd, std::string(size, 'a'));
      reason = errno;
    }
    ::close(fd);
    EXPECT_EQ(whole, size <= room) << size << " bytes, room for " << room;
    EXPECT_EQ(reason, whole ? ENOENT : EFBIG) << size << " bytes, room for " << room;
    EXPECT_EQ(std::filesystem::file_size(file), std::min(size, room));
  }
}

}  // namespace
}  // namespace skein
