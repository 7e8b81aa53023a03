// Where `skein pack` may write, and what it leaves when it cannot.
#include "cli/pack_command.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::cli {
namespace {

class PackCommand : public ::testing::Test {
 protected:
  std::string refusal(const std::filesystem::path& file) {
    std::ostringstream out;
    try {
      pack_programs({file, {}}, {out, out});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const FakePrograms programs_;  // scripts, which `ldd` refuses
  const ScratchFolder folder_;
};

TEST_F(PackCommand, ATargetThatIsNoFileIsRefusedBeforeAnythingIsDone) {
  EXPECT_EQ(refusal(folder_.path()), folder_.path().string() + ": is a folder; name the archive, as skein.tar.gz");
  const std::filesystem::path file = folder_.path() / "file";
  std::ofstream(file) << "text";
  EXPECT_EQ(refusal(file / "skein.tar.gz"), file.string() + ": is not a folder, so no archive can be made in it");
  EXPECT_FALSE(std::filesystem::exists(folder_.path().string() + ".tmp"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path().string() + ".parts"));
}

}  // namespace
}  // namespace skein::cli
