#include "core/files/write_whole.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <random>
#include <string>

#include "tests/support/limited_files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

TEST(WriteWhole, WritesAllOrReportsTheReason) {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.path() / "file";
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const std::size_t size = random() % 1000, room = random() % 1000;
    const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    ASSERT_GE(fd, 0);
    errno = ENOENT;  // an old error of another call
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
