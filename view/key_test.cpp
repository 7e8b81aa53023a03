#include "view/key.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/types.hpp"
#include "process/files/private_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;

class KeyFile : public testing::Test {
 protected:
  const ScratchFolder scratch_;
  const fs::path& folder_ = scratch_.path();
};

TEST(Keys, AreRandomAndEqualOnlyThemselves) {
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

TEST_F(KeyFile, CanBeReadOnlyByItsOwner) {
  const Key key = Key::draw();
  const fs::path file = folder_ / "view.key";
  write_private_file(file, key.text() + "\n");
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  EXPECT_TRUE(Key::read_from(file).opens(key.text()));
  ::chmod(file.c_str(), 0640);
  EXPECT_THROW(Key::read_from(file), InputError) << "a file that others may read is refused";
}

TEST_F(KeyFile, InvalidKeyFilesAreRefused) {
  EXPECT_THROW(Key::read_from(folder_ / "missing"), InputError);
  for (const std::string& text : {std::string(), std::string(64, 'x'), std::string(63, '0'), std::string(65, '0')}) {
    write_private_file(folder_ / "view.key", text);
    EXPECT_THROW(Key::read_from(folder_ / "view.key"), InputError) << text;
  }
}

}  // namespace
}  // namespace skein::view
