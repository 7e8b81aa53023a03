#include "view/key.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>

#include "core/types.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;

class KeyFile : public testing::Test {
 protected:
  const ScratchFolder scratch_;
  const fs::path& folder_ = scratch_.path();
};

TEST(Keys, AreDrawnAnewAndOpenOnlyForThemselves) {
  const Key one = Key::draw(), other = Key::draw();
  EXPECT_EQ(one.text().size(), 64U);
  EXPECT_TRUE(one.opens(one.text()));
  EXPECT_FALSE(one.opens(other.text()));
  EXPECT_FALSE(one.opens(""));
  EXPECT_FALSE(one.opens(one.text().substr(1)));
  EXPECT_FALSE(one.opens(one.text() + "0"));
  std::string nearly = one.text();
  nearly.back() = nearly.back() == '0' ? '1' : '0';
  EXPECT_FALSE(one.opens(nearly));
}

TEST_F(KeyFile, IsReadByItsOwnerAlone) {
  const Key key = Key::draw();
  const fs::path file = folder_ / "view.key";
  write_private_file(file, key.text() + "\n");
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  EXPECT_TRUE(Key::read_from(file).opens(key.text()));
  ::chmod(file.c_str(), 0640);
  EXPECT_THROW(Key::read_from(file), InputError) << "others may read it";
}

/// What write_private_file() says if a file may have only so many bytes; nullopt: it wrote the whole text.
std::optional<std::string> complaint_with_room(rlim_t bytes, const fs::path& file, std::string_view text) {
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = before;
  limit.rlim_cur = bytes;
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::optional<std::string> complaint;
  try {
    write_private_file(file, text);
  } catch (const std::runtime_error& error) {
    complaint = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  return complaint;
}

TEST_F(KeyFile, TellsTheSystemsReasonWhenItIsWrittenInPart) {
  const fs::path file = folder_ / "view.key";
  const std::string text(64, 'a');
  for (const rlim_t room : {0U, 1U, 63U}) {
    errno = ENOENT;  // of another call, long ago
    EXPECT_EQ(complaint_with_room(room, file, text), file.string() + ": " + std::strerror(EFBIG)) << room;
  }
  EXPECT_EQ(complaint_with_room(64, file, text), std::nullopt);
  EXPECT_EQ(fs::file_size(file), 64U);
}

TEST_F(KeyFile, OfAnythingElseIsNone) {
  EXPECT_THROW(Key::read_from(folder_ / "missing"), InputError);
  for (const std::string& text : {std::string(), std::string(64, 'x'), std::string(63, '0'), std::string(65, '0')}) {
    write_private_file(folder_ / "view.key", text);
    EXPECT_THROW(Key::read_from(folder_ / "view.key"), InputError) << text;
  }
}

TEST_F(KeyFile, ReplacesALinkAndDoesNotFollowIt) {
  std::ofstream(folder_ / "mine") << "mine";
  fs::create_symlink(folder_ / "mine", folder_ / "view.key");
  write_private_file(folder_ / "view.key", "secret");
  EXPECT_FALSE(fs::is_symlink(folder_ / "view.key"));
  std::string text;
  std::ifstream(folder_ / "mine") >> text;
  EXPECT_EQ(text, "mine");
}

}  // namespace
}  // namespace skein::view
