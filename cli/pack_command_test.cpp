// Where `skein pack` may write its archive, and which files remain if it fails.
#include "cli/pack_command.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "tests/support/limited_files.hpp"
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

TEST_F(PackCommand, ATargetThatIsNotAFileIsRefusedBeforeAnythingIsDone) {
  EXPECT_EQ(refusal(folder_.path()), folder_.path().string() + ": is a folder; name the archive, as skein.tar.gz");
  const std::filesystem::path file = folder_.path() / "file";
  std::ofstream(file) << "text";
  EXPECT_EQ(refusal(file / "skein.tar.gz"), file.string() + ": is not a folder, so no archive can be made in it");
  EXPECT_FALSE(std::filesystem::exists(folder_.path().string() + ".tmp"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path().string() + ".parts"));
}

TEST_F(PackCommand, ANameOfAnotherKindOfArchiveIsRefused) {
  for (const char* name : {"skein.zip", "skein.tar", "skein", "skein.tar.xz"}) {
    const std::filesystem::path file = folder_.path() / name;
    EXPECT_EQ(refusal(file),
              file.string() + ": the archive is a compressed tar file; let its name end in .tar.gz or .tgz");
    EXPECT_FALSE(std::filesystem::exists(file));
  }
  EXPECT_EQ(refusal(folder_.path() / "skein.tgz").find("the archive is"), std::string::npos);
}

/// Replaces Skein's programs with binaries that `ldd` can read.
class PackedPrograms : public PackCommand {
 protected:
  PackedPrograms() {
    for (const char* name :
         {"skein", "sim_server", "comm_router", "station", "uav_agent", "skein_doctor", "uav_agent_fleet"}) {
      std::filesystem::copy_file(std::filesystem::canonical("/bin/true"), programs_.dir() / name,
                                 std::filesystem::copy_options::overwrite_existing);
    }
  }

  std::string trouble() {
    std::ostringstream out;
    try {
      pack_programs({archive_, {}}, {out, out});
    } catch (const InputError& error) {
      return std::string("the user's mistake: ") + error.what();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  void expect_only_the_former_archive() const {
    EXPECT_EQ(read_text(archive_), "former");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1) << "nothing else is left";
  }

  const std::filesystem::path archive_ = folder_.path() / "skein.tar.gz";
};

TEST_F(PackedPrograms, AFileThatIsNotAProgramIsNamed) {
  const std::filesystem::path station = programs_.dir() / "station";
  std::filesystem::remove(station);
  write_script(station, "");
  const std::string begin = "the user's mistake: " + station.string() + ": its libraries cannot be listed: ldd ended";
  EXPECT_EQ(trouble().find(begin), 0U) << trouble();
}

TEST_F(PackedPrograms, OnAFullDiskTheFormerArchiveStaysAndIsNamed) {
  write_text(archive_, "former");
  {
    const LimitedFiles full(20 << 10);  // less than the size of a program
    EXPECT_EQ(trouble(), "cannot write " + archive_.string() + ": File too large");
  }
  expect_only_the_former_archive();
  write_script(folder_.path() / "gzip", "cat >/dev/null\necho 'gzip: stdout: No space left on device' >&2\nexit 1\n");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder_.path().string() + ":" + path).c_str(), 1);
  const std::string said = trouble();
  ::setenv("PATH", path.c_str(), 1);
  std::filesystem::remove(folder_.path() / "gzip");
  EXPECT_TRUE(said.starts_with("cannot write " + archive_.string() + ": tar ended with exit code 2:")) << said;
  expect_only_the_former_archive();
  EXPECT_EQ(trouble(), "");
  EXPECT_GT(std::filesystem::file_size(archive_), 100U << 10);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1) << "nothing else is left";
}

}  // namespace
}  // namespace skein::cli
