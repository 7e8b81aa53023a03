#include "process/files/private_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>

#include "core/files/file_bytes.hpp"
#include "tests/support/limited_files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

class PrivateFile : public testing::Test {
 protected:
  const ScratchFolder scratch_;
  const fs::path file_ = scratch_.path() / "key";
};

/// The error of write_private_file() under a limit of the file size; nullopt: it wrote the whole text.
std::optional<std::string> complaint_with_room(rlim_t bytes, const fs::path& file, std::string_view text) {
  const LimitedFiles limited(bytes);
  try {
    write_private_file(file, text);
  } catch (const std::system_error& error) {
    return error.what();
  }
  return {};
}

TEST_F(PrivateFile, AnIncompleteWriteReportsTheSystemsReason) {
  const std::string text(64, 'a');
  for (const rlim_t room : {0U, 1U, 63U}) {
    errno = ENOENT;  // an earlier call has left this value
    EXPECT_EQ(complaint_with_room(room, file_, text), file_.string() + ": " + std::strerror(EFBIG)) << room;
    EXPECT_FALSE(fs::exists(file_)) << "a part of a key is left, with " << room << " bytes of room";
  }
  EXPECT_EQ(complaint_with_room(64, file_, text), std::nullopt);
  EXPECT_EQ(fs::file_size(file_), 64U);
}

TEST_F(PrivateFile, ReplacesAFileThatOthersMayReadOrThatIsReadOnly) {
  for (const unsigned before : {0644U, 0400U}) {
    std::ofstream(file_) << "former";
    ASSERT_EQ(::chmod(file_.c_str(), before), 0);
    write_private_file(file_, "secret");
    struct stat status {};
    ASSERT_EQ(::stat(file_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    EXPECT_EQ(read_file_bytes(file_, 1024), "secret");
  }
}

TEST_F(PrivateFile, ReplacesALinkAndDoesNotFollowIt) {
  const fs::path mine = scratch_.path() / "mine";
  std::ofstream(mine) << "mine";
  fs::create_symlink(mine, file_);
  write_private_file(file_, "secret");
  EXPECT_FALSE(fs::is_symlink(file_));
  EXPECT_EQ(read_file_bytes(mine, 1024), "mine");
}

TEST_F(PrivateFile, CannotBeWrittenToAMissingFolder) {
  EXPECT_THROW(write_private_file(scratch_.path() / "missing" / "key", "secret"), std::system_error);
}

}  // namespace
}  // namespace skein
