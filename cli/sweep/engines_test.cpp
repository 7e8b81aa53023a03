// The number of threads that a node gives the unit that it flies.
#include "cli/sweep/engines.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include "cli/sweep/folder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

class FlyScript : public testing::Test {
 protected:
  FlyScript() {
    const fs::path launcher = scratch_.path() / "launcher";
    std::ofstream(launcher) << "#!/bin/sh\necho \"$SKEIN_THREADS\" >" << (scratch_.path() / "said").string() << "\n";
    ::chmod(launcher.c_str(), 0755);
    ::setenv("SKEIN_LAUNCHER", launcher.c_str(), 1);
    fs::create_directories(folder_.dir() / "log");
  }
  ~FlyScript() override { ::unsetenv("SKEIN_LAUNCHER"); }

  /// The number of threads that the script gives a unit. @param variables  environment of the node, for env(1)
  std::string threads(const std::optional<int>& jobs, const std::string& variables = "") {
    write_fly_script(folder_, scratch_.path(), scratch_.path(), jobs);
    const std::string command = "env -u SKEIN_THREADS " + variables + " /bin/sh " + fly_script(folder_).string() + " 0";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::string said;
    std::getline(std::ifstream(scratch_.path() / "said") >> std::ws, said);
    return said;
  }

  ScratchFolder scratch_;
  SweepFolder folder_{scratch_.path()};
};

TEST_F(FlyScript, AUnitUsesTheCoresThatSlurmGaveIt) {
  EXPECT_EQ(threads({}, "SLURM_CPUS_ON_NODE=3"), "3");
  EXPECT_EQ(threads(2, "SLURM_CPUS_ON_NODE=1"), "1");
}

TEST_F(FlyScript, SlotsShareTheCores) {
  EXPECT_EQ(threads({}), "1") << "by default, there are as many slots as cores";
  EXPECT_EQ(threads(1000), "1");
  EXPECT_GE(std::stoi(threads(1)), 1);
}

TEST_F(FlyScript, TheUsersNumberOfThreadsTakesPrecedence) {
  EXPECT_EQ(threads({}, "SKEIN_THREADS=5 SLURM_CPUS_ON_NODE=3"), "5");
}

}  // namespace
}  // namespace skein::cli
