#include "cli/secure/security.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <system_error>

#include "tests/support/scratch_folder.hpp"

namespace skein::cli {
namespace {

/// The error of write_private_file() if files may have only so many bytes, as on a disk that becomes full; 0: none.
int error_with_room(rlim_t bytes, const std::filesystem::path& file, const std::string& text) {
  rlimit usual{};
  ::getrlimit(RLIMIT_FSIZE, &usual);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limited{bytes, usual.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &limited);
  int code = 0;
  try {
    errno = ENOENT;  // of another call, long ago
    write_private_file(file, text);
  } catch (const std::system_error& error) {
    code = error.code().value();
  }
  ::setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, handler);
  return code;
}

TEST(KeyFiles, TellTheSystemsReasonWhenTheyAreWrittenInPart) {
  const ScratchFolder scratch;
  const std::string text(64, 'a');
  for (const rlim_t room : {0U, 1U, 63U}) {
    const auto file = scratch.path() / std::to_string(room);
    EXPECT_EQ(error_with_room(room, file, text), EFBIG) << room;
  }
  const auto file = scratch.path() / "whole";
  EXPECT_EQ(error_with_room(64, file, text), 0);
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0400U);
  EXPECT_EQ(status.st_size, 64);
  EXPECT_EQ(error_with_room(64, file, text), EEXIST);
}

}  // namespace
}  // namespace skein::cli
